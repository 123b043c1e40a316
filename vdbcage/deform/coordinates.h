#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// How a cage moves what is in it. Quads are bilinear patches, but for the families that split them: there they are two
/// triangles each, along the diagonal that is shorter at rest.
enum class Coordinates {
    /// Mean value coordinates: Ju, Schaefer, Warren 2005 on triangles; Thiery, Memari, Boubekeur 2018 on quads. Defined
    /// everywhere, also outside of the cage. Smooth but on the cage, where they interpolate it. Can be negative.
    meanValue,
    /// Green coordinates: Lipman, Levin, Cohen-Or 2008 on triangles; Thiery, Boubekeur 2022 on quads. They follow the
    /// faces' normals and nearly keep shapes. So the posed model does not touch the cage where the rest model does.
    /// Defined inside and, as the limit from inside, on the cage; an error outside.
    green,
    /// Maximum likelihood coordinates, after Chang, Deng, Hormann 2023: never negative. They are the most local family
    /// here: the weights fall as the third power of the distance. Chosen before harmonic coordinates because they need
    /// no volume mesh, and so keep the rest pose and affine maps exactly at every point. Defined inside and on the
    /// cage, which they interpolate; an error outside.
    maximumLikelihood,
    /// Harmonic coordinates: Joshi, Meyer, DeRose, Green, Sanocki 2007. Never negative, and smooth: nothing of the cage
    /// acts through a wall of it, so they are local without being stiff. Solved for on a grid, see CoordinateOptions.
    /// Defined inside and on the cage, which they interpolate; an error outside.
    harmonic,
    /// Biharmonic coordinates: Thiery, Michel, Chen 2024. As Green coordinates they follow the faces' normals, but keep
    /// closer to a bent cage. Of points and triangles together there can be 6000. Defined inside and, as the limit from
    /// inside, on the cage; an error outside.
    biharmonic,
    /// Somigliana coordinates: Chen, de Goes, Desbrun 2023. The inside moves as an elastic material does whose surface
    /// is moved by the cage: stretched evenly, and not sheared where Green coordinates shear it. See Elasticity. Like
    /// Green coordinates they do not interpolate the cage. Defined inside and, as the limit from inside, on the cage;
    /// an error outside.
    somigliana,
    /// Weights that were made elsewhere, of any family: one a cage point. They cannot be computed, nor be had at other
    /// points. See readWeights. The cage may be open.
    given,
};

/// The material of Somigliana coordinates. It acts in the pose, not in the weights.
struct VDBCAGE_API Elasticity {
    /// What the material turns with.
    enum class Rotations {
        global, ///< the elastic material turns as a whole. For parts that turn up to a quarter turn from the mean
        local   ///< at each face as the face does. For parts that turn farther; stretches more
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

    /// Whether all four are exactly the same.
    bool operator==(const Elasticity& other) const;
    /// Whether one of them differs.
    bool operator!=(const Elasticity& other) const { return !(*this == other); }
};

/// Checks the numbers of a material.
/// \throw InputError naming the first that is out of range
VDBCAGE_API void requireElasticity(const Elasticity& elasticity);

/// "global" or "local".
VDBCAGE_API const char* rotationsName(Elasticity::Rotations rotations);

/// \throw InputError there are none of that name
VDBCAGE_API Elasticity::Rotations rotationsNamed(const std::string& name);

/// Facts about a family, for menus and help.
struct FamilyInfo {
    Coordinates family;      ///< its value
    const char* name;        ///< of the command and of weights files; at most 16 letters
    const char* nameOnQuads; ///< as its paper calls it on quads; `name` if it has no other there
    const char* title;       ///< a word or two
    const char* what;        ///< what it does to the model, in a line
    const char* paper;       ///< authors and year
    bool isEverywhere;       ///< else inside the cage and on it only
    bool splitsQuads;        ///< takes quads as two triangles
    bool hasResolution;      ///< looks at CoordinateOptions::resolution
    bool hasElasticity;      ///< looks at CoordinateOptions::elasticity
};

/// Lists all families that can be computed, in the order of Coordinates.
VDBCAGE_API const std::vector<FamilyInfo>& coordinateFamilies();

/// Finds the facts about any family, `given` included.
VDBCAGE_API const FamilyInfo& familyInfo(Coordinates family);

/// The name of a family, or "given".
VDBCAGE_API const char* coordinatesName(Coordinates family);

/// The family of a name, of those that can be computed. "qmvc" and "qgc" are other names of "mvc" and "green", as their
/// papers call them on quads.
/// \throw InputError naming the families
VDBCAGE_API Coordinates coordinatesNamed(const std::string& name);

/// Points that need no coordinates of a family, such as those that no face of a model uses.
struct LoosePoints {
    /// How they move.
    enum class Motion {
        ride, ///< by the family where it is defined, and elsewhere by mean value coordinates
        stay  ///< not at all: their weights are 0
    };
    std::vector<openvdb::Index32> indices = {}; ///< ascending; see loosePoints()
    Motion motion = Motion::ride;               ///< of all of them
};

/// \throw InputError there is none of that name: "ride" or "stay"
VDBCAGE_API LoosePoints::Motion looseMotionNamed(const std::string& name);

/// A family, and what it can be asked for.
struct CoordinateOptions {
    static constexpr Range resolutions{4, 256}; ///< of `resolution`

    Coordinates family; ///< whose weights they are
    /// Of harmonic coordinates: voxels along the cage's longest side. What the weights of a point are off by has a mean
    /// sum of 2.4 % in 64 voxels and 0.7 % in 128 (cage of 400 faces), most near the cage. 8 bytes for each voxel
    /// inside and point of the cage.
    int resolution;
    /// Of Somigliana coordinates. Weights do not depend on it.
    Elasticity elasticity;
    LoosePoints loose; ///< of the points that are bound

    /// The family `of`. `voxels` is the resolution, which only harmonic coordinates look at.
    CoordinateOptions(Coordinates of, int voxels = 64) : family(of), resolution(voxels) {}
    /// The family `of`, with a material, which only Somigliana coordinates look at.
    CoordinateOptions(Coordinates of, const Elasticity& material) : CoordinateOptions(of) { elasticity = material; }
};

/// How many handles a cage has, which is the number of weights a point.
VDBCAGE_API std::size_t handleCount(const Mesh& cage, Coordinates family);

/// What coordinates are weights of, in the order of their columns. `posed` are the posed points of `cage`.
///
/// First come the posed points. For Green coordinates stretched normals follow: one a triangle, then four a quad, at
/// its corners. For biharmonic ones, too: one a triangle, then two a quad, of its halves along the diagonal that is
/// shorter at rest. A stretched normal belongs to two edges that meet in a corner. Its length is the area of their
/// parallelogram at rest, times how much the pose stretches it, over the longest side of the cage at rest. The stretch
/// is the root mean square of the two principal stretches.
///
/// For Somigliana coordinates six vectors a triangle follow, two triangles a quad. They are what the entries of the
/// integral of r r^T / (4 pi |r|^3) over the triangle stand for, in the frame of its normal, its first edge and the
/// normal cross that: nn, n1, n2, 11, 12, 22. Each is as long as what the point moves by for an entry of 1, in units
/// of the longest side of the cage at rest.
/// \throw InputError not as many points as `cage` has, or one not finite; an elasticity out of range
/// Cost: O(cage).
VDBCAGE_API std::vector<openvdb::Vec3d> cageHandles(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed,
                                                    const CoordinateOptions& options);

/// The coordinates of `points` in `cage`, in double: a row a point, row after row, of as many columns as there are
/// handles.
///
/// Point i is the sum over the handles at rest, each times its weight, to 1e-12 of the cage's size. The weights of the
/// cage's points have sum 1; those of points that no face uses are 0. The weights are accurate to 1e-7, less where
/// faces meet at a distance below 1e-7 of the cage's size. Harmonic ones reproduce points to 1e-10, and are as accurate
/// as their grid is fine. Points at less than 1e-12 of the cage's size from it count as on it.
///
/// Self-intersections are not looked for. Degenerate faces are allowed. The same bits for any number of threads and for
/// all instruction sets of a processor.
/// \pre `cage` is closed and faces outward
/// \throw InputError a cage that is not closed, faces inward or is flat; a point not finite; a point for which the
/// family is not defined and that is not loose (the message has the first and how many); the family is `given`; a loose
/// point that is not there; a cage too large for
/// biharmonic coordinates; a resolution of harmonic coordinates out of range
/// \throw Cancelled
/// Cost: O(points x faces), in parallel. Quads cost several times what triangles do. Biharmonic coordinates:
/// O(handles^3 + points x handles^2), in 32 bytes x handles^2, of which 8 stay.
VDBCAGE_API std::vector<double> computeCoordinates(const Mesh& cage, const std::vector<openvdb::Vec3d>& points,
                                                   const CoordinateOptions& options,
                                                   Interrupter* interrupter = nullptr);

/// computeCoordinates(), rounded to single precision, as Binding and weights files take them.
/// \throw InputError as computeCoordinates
/// \throw Cancelled
VDBCAGE_API std::vector<float> computeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points,
                                              const CoordinateOptions& options, Interrupter* interrupter = nullptr);

} // namespace vdbcage
