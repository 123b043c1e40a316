#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// A family of coordinates: the rule by which a cage moves the points in it. Quads are bilinear patches, except in the
/// families that split them: there they are two triangles each, along the diagonal that is shorter at rest.
enum class Coordinates {
    /// Mean value coordinates: Ju, Schaefer, Warren 2005 on triangles; Thiery, Memari, Boubekeur 2018 on quads. Defined
    /// everywhere, also outside of the cage. Smooth except on the cage, which they interpolate. Can be negative.
    meanValue,
    /// Green coordinates: Lipman, Levin, Cohen-Or 2008 on triangles; Thiery, Boubekeur 2022 on quads. They follow the
    /// faces' normals and nearly keep shapes, so the posed model does not touch the cage where the model at rest does.
    /// Defined inside and, as the limit from inside, on the cage; an error outside.
    green,
    /// Maximum likelihood coordinates, after Chang, Deng, Hormann 2023: never negative. They are the most local family
    /// here: the weights fall as the third power of the distance. They need no volume mesh, unlike harmonic
    /// coordinates, and so keep the rest pose and affine maps exactly at every point. Defined inside and on the cage,
    /// which they interpolate; an error outside.
    maximumLikelihood,
    /// Harmonic coordinates: Joshi, Meyer, DeRose, Green, Sanocki 2007. Never negative, and smooth. No part of the cage
    /// acts through a wall of it, so they are local without being stiff. Solved for on a grid, see CoordinateOptions.
    /// Defined inside and on the cage, which they interpolate; an error outside.
    harmonic,
    /// Biharmonic coordinates: Thiery, Michel, Chen 2024. They follow the faces' normals as Green coordinates do, but
    /// keep closer to a bent cage. The cage has at most 6000 points and triangles together. Defined inside and, as the
    /// limit from inside, on the cage; an error outside.
    biharmonic,
    /// Somigliana coordinates: Chen, de Goes, Desbrun 2023. The inside moves as an elastic material does whose surface
    /// is moved by the cage: stretched evenly, and not sheared where Green coordinates shear it. See Elasticity. Like
    /// Green coordinates they do not interpolate the cage. Defined inside and, as the limit from inside, on the cage;
    /// an error outside.
    somigliana,
    /// Weights that were made elsewhere, of any family: one a cage point. They cannot be computed, and are not known at
    /// other points; see readWeights(). The cage may be open.
    given,
};

/// The material of Somigliana coordinates. It acts in the pose, not in the weights.
struct VDBCAGE_API Elasticity {
    /// The rotations that the material follows.
    enum class Rotations {
        global, ///< the material turns as a whole. For parts that turn up to a quarter turn from the mean
        local   ///< the material at each face turns with the face. For parts that turn farther; stretches more
    };
    static constexpr Range bulgings{0, 100}; ///< of `localBulging` and `globalBulging`

    /// Poisson's ratio, above -1 and below 0.5: how much the material gets thinner where it is stretched. Near 0.5 the
    /// pose reacts strongly to the cage.
    double nu = 0;
    Rotations rotations = Rotations::global; ///< for the whole, or face by face
    /// How much the surface bulges where the cage's normals come to spread more, in `bulgings`.
    double localBulging = 0;
    /// How much it bulges where the cage moves outward, from its rest pose turned and scaled to fit, in `bulgings`.
    double globalBulging = 0;

    /// Returns whether all four are exactly the same.
    bool operator==(const Elasticity& other) const;
    /// Returns whether one of them differs.
    bool operator!=(const Elasticity& other) const { return !(*this == other); }
};

/// Checks the numbers of a material.
/// \param elasticity its numbers are to be in the ranges of its members
/// \throw InputError when one is out of range; names the first
VDBCAGE_API void requireElasticity(const Elasticity& elasticity);

/// Returns the name of the rotations: "global" or "local".
/// \param rotations either of the two
VDBCAGE_API const char* rotationsName(Elasticity::Rotations rotations);

/// Returns the rotations of a name.
/// \param name "global" or "local"
/// \throw InputError when it is neither
VDBCAGE_API Elasticity::Rotations rotationsNamed(const std::string& name);

/// Facts about a family, for menus and help.
struct FamilyInfo {
    Coordinates family;      ///< its value
    const char* name;        ///< of the command and of weights files; at most 16 letters
    const char* nameOnQuads; ///< as its paper calls it on quads; `name` if it has no other there
    const char* title;       ///< a word or two
    const char* what;        ///< its effect on the model, in a line
    const char* paper;       ///< authors and year
    bool isEverywhere;       ///< it is defined everywhere, not only inside the cage and on it
    bool splitsQuads;        ///< it takes quads as two triangles
    bool hasResolution;      ///< it uses CoordinateOptions::resolution
    bool hasElasticity;      ///< it uses CoordinateOptions::elasticity
};

/// Lists all families that can be computed, in the order of Coordinates.
VDBCAGE_API const std::vector<FamilyInfo>& coordinateFamilies();

/// Returns the facts about a family.
/// \param family any, `given` too
VDBCAGE_API const FamilyInfo& familyInfo(Coordinates family);

/// Returns the name of a family, such as "mvc"; or "given".
/// \param family any, `given` too
VDBCAGE_API const char* coordinatesName(Coordinates family);

/// Returns the family of a name, one of those that can be computed.
/// \param name FamilyInfo::name, or FamilyInfo::nameOnQuads: "qmvc" and "qgc" are other names of "mvc" and "green"
/// \throw InputError when there is none of that name; lists the families
VDBCAGE_API Coordinates coordinatesNamed(const std::string& name);

/// Points that need no coordinates of a family, such as those that no face of a model uses.
struct LoosePoints {
    /// The ways in which they move.
    enum class Motion {
        ride, ///< by the family where it is defined, and elsewhere by mean value coordinates
        stay  ///< not at all: their weights are 0
    };
    std::vector<openvdb::Index32> indices = {}; ///< ascending; see loosePoints()
    Motion motion = Motion::ride;               ///< of all of them
};

/// Returns the motion of a name.
/// \param name "ride" or "stay"
/// \throw InputError when it is neither
VDBCAGE_API LoosePoints::Motion looseMotionNamed(const std::string& name);

/// A family with its settings.
struct CoordinateOptions {
    static constexpr Range resolutions{4, 256}; ///< of `resolution`

    Coordinates family; ///< whose weights they are
    /// Voxels along the cage's longest side, in `resolutions`, default 64; only harmonic coordinates use it. The errors
    /// of a point's weights have a mean sum of 2.4 % in 64 voxels and 0.7 % in 128 (cage of 400 faces), most near the
    /// cage. The grid takes 8 bytes for each voxel inside and point of the cage.
    int resolution;
    /// The material; only Somigliana coordinates use it, and their weights do not depend on it.
    Elasticity elasticity;
    LoosePoints loose; ///< of the points that are bound; none by default

    /// Takes a family and a resolution.
    /// \param of any family
    /// \param voxels `resolution`: 4 to 256, default 64
    CoordinateOptions(Coordinates of, int voxels = 64) : family(of), resolution(voxels) {}
    /// Takes a family and a material.
    /// \param of any family
    /// \param material `elasticity`: in the ranges of its members
    CoordinateOptions(Coordinates of, const Elasticity& material) : CoordinateOptions(of) { elasticity = material; }
};

/// Returns the number of handles of a cage, which is the number of weights a point.
/// \param cage any mesh
/// \param family any, `given` too
VDBCAGE_API std::size_t handleCount(const Mesh& cage, Coordinates family);

/// Returns the handles of a posed cage, which weights multiply, in the order of the weights' columns: first the posed
/// points, then the vectors of the family. \ref deform describes these.
/// \param cage at rest
/// \param posed the points of `cage` in the pose: as many, in the same order, finite
/// \param options the family, and the material of Somigliana coordinates
/// \throw InputError when there are not as many points as `cage` has, or one is not finite; when the elasticity is out
/// of range
/// Cost: O(cage).
VDBCAGE_API std::vector<openvdb::Vec3d> cageHandles(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed,
                                                    const CoordinateOptions& options);

/// Returns the coordinates of points in a cage: points x handles, row after row. \ref deform has their accuracy.
/// \param cage closed and facing outward; it may have degenerate faces, and self-intersections are not looked for
/// \param points world units, finite; where the family is defined, or loose
/// \param options the family with its settings; not `given`
/// \param interrupter told of the stage "bind"; may be null
/// \throw InputError when the cage is not closed, faces inward, is flat, or is too large for biharmonic coordinates;
/// when a point is not finite, or is not loose where the family is not defined (names the first, and their number);
/// when the family is `given`; when a loose point is not there; when a resolution of harmonic coordinates is out of
/// range
/// \throw Cancelled when asked to stop
/// Cost: O(points x faces), in parallel; a quad costs as much as several triangles. Biharmonic coordinates:
/// O(handles^3 + points x handles^2), in 32 bytes x handles^2, of which 8 stay.
VDBCAGE_API std::vector<double> computeCoordinates(const Mesh& cage, const std::vector<openvdb::Vec3d>& points,
                                                   const CoordinateOptions& options,
                                                   Interrupter* interrupter = nullptr);

/// As computeCoordinates(), rounded to single precision, as Binding and weights files take them.
/// \throw InputError as computeCoordinates()
/// \throw Cancelled when asked to stop
VDBCAGE_API std::vector<float> computeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points,
                                              const CoordinateOptions& options, Interrupter* interrupter = nullptr);

} // namespace vdbcage
