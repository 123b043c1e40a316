#pragma once

#include <optional>
#include <string>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/effort.h>
#include <vdbcage/bounding/joints.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/core/range.h>
#include <vdbcage/volume/factor_field.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/voxelize/voxelize.h>

namespace vdbcage {

/// The faces that a cage is made of.
enum class CageFaces {
    triangles, ///< no quads
    triquad,   ///< triangles, merged into quads where they are flat enough
    quads,     ///< of at least 87 % of the faces, where it can
    loops      ///< quads only, in rings around limbs, as drawn by hand; looser than quads; bounding only
};

/// The treatment of parts of the model that the closing leaves apart.
enum class CageParts {
    keep, ///< each may get a cage of its own, where the faces suffice
    merge ///< one cage around everything
};

/// The plane in which a cage is symmetric.
enum class CageSymmetry {
    automatic, ///< in one that the model is symmetric in: across x, y or z, or else in any direction
    off,       ///< in none
    x,         ///< in the plane across x in which the model agrees best with its mirror image
    y,         ///< the same across y
    z          ///< the same across z
};

/// The options that decide how a cage comes out. Lengths are fractions of the model's longest side.
///
/// Members that are not set are chosen by vdbcage; docs/user/OPTIONS.md says how. Values out of their range are an
/// InputError of Pipeline::run() and makeCage().
struct CageOptions {
    static constexpr Range resolutions{8, 2048}; ///< of `resolution`

    /// Faces of the cage, at most: leastFaces() to 1000000. A quad counts once.
    int faces = 400;
    /// Voxels along the model's longest side, 8 to 2048. Halves of it down to 24 compete with it, so that doubling it,
    /// from 24 on, never makes the cage looser. Unset: by the faces and the effort.
    std::optional<int> resolution;
    /// Gaps up to twice this wide are bridged, 0 to 0.25. Unset: 0.03, or more where the faces need it.
    std::optional<double> closeRadius;
    /// Where less than the close radius, the closing is thicker by the difference: an offset of the cage without
    /// `bounding`. With it the cage is tightened onto the model all the same, and `clearance` makes room instead.
    /// 0 to the close radius, which must be set. Unset: equal to it.
    std::optional<double> erodeRadius;
    StructuringElement element = StructuringElement::sphere; ///< of the closing
    /// Factors of the close radius and the erode radius in places; for the sphere only.
    FactorField scale;
    /// About how many times the faces a place of the model gets, at the cost of the others. Needs `bounding`.
    FactorField density;
    /// Places where it is to bend: three rings of quads with CageFaces::loops, twice the faces with others. Needs
    /// `bounding`.
    Joints joints;
    /// Sweeps of smoothing, 0 to 100: rounder, and less tight, with more. They smooth the cage or, without `bounding`,
    /// the surface before it is decimated. Unset: 0, or 3 without `bounding`.
    std::optional<int> smooth;
    CageParts parts = CageParts::keep; ///< the treatment of separate parts of the closing
    /// Share of the largest part, 0 to 1: parts of the model that are smaller, by the longest sides of their boxes, are
    /// left out. The cage need not bound them.
    double leastPart = 0;
    /// Least distance from model to cage, 1e-7 to 0.1.
    double clearance = GuardOptions{}.clearance;
    /// No triangle angle gets smaller, in degrees, 0 to 30. Unset: 1, 6 or 10, see docs/user/OPTIONS.md.
    std::optional<double> minAngle;
    Precision precision = Precision::automatic; ///< of the cage's coordinates; for a file see precisionOf()
    Effort effort = Effort::fair;               ///< time against tightness
    CageFaces mesh = CageFaces::triangles;      ///< triangles only, or quads too
    /// Shape of the quads of CageFaces::triquad and CageFaces::quads: 0 is tightest, 1 has the squarest corners.
    double quadShape = BoundingTriquadOptions{}.quadShape;
    /// Triangles that meet at a smaller angle become quads, in degrees, 0 to 180. Unset: 30 of CageFaces::triquad, or
    /// 10 without `bounding`; 90 of CageFaces::quads.
    std::optional<double> mergeAngle;
    /// Symmetry of the cage. Needs `bounding`, without which CageSymmetry::automatic makes no cage symmetric.
    CageSymmetry symmetry = CageSymmetry::off;
    /// The largest Symmetry::deviation with which CageSymmetry::automatic takes a plane, 0 to 0.3.
    double symmetryTolerance = 0.005;
    Interior interior = Interior::automatic;    ///< the inside of a model with holes
    Voxelizer voxelizer = Voxelizer::automatic; ///< the code that turns the model into voxels
    /// Only a cage that is certified to bound the model is returned. If false, plain operators are used, and the cage
    /// is returned whatever the verdict.
    bool bounding = true;
};

/// Facts about an option beside its value: one entry serves flags, help, range checks, docs/user/OPTIONS.md and
/// metadata.
struct OptionInfo {
    const char* name;    ///< lower case with dashes: the flag without its leading dashes
    const char* symbol;  ///< stands for a number in the help ("N"); empty for names out of a list
    const char* help;    ///< one line
    Range range = {};    ///< allowed for a number
    bool isRare = false; ///< most users never need it: it is in the full help only
};

/// Calls a function for every option, in the order of the help.
/// \param options CageOptions, const or not
/// \param visit called as `visit(info, field)`: with an OptionInfo and the member of `options`
template <typename Options, typename Visit>
void visitOptions(Options& options, Visit&& visit)
{
    visit(OptionInfo{"faces", "N", "faces of the cage, at most", {4, 1000000}}, options.faces);
    visit(OptionInfo{"resolution", "N", "voxels along the longest side", CageOptions::resolutions}, options.resolution);
    visit(OptionInfo{"close-radius", "F", "bridges gaps up to twice it", {0, 0.25}}, options.closeRadius);
    visit(OptionInfo{"erode-radius", "F", "if less, offset without bounding", {0, 0.25}, true}, options.erodeRadius);
    visit(OptionInfo{"element", "", "shape of the closing", {}, true}, options.element);
    visit(OptionInfo{"scale-field", "FILE.vdb|REGION", "multiplies the close radius in places"}, options.scale);
    visit(OptionInfo{"density", "FILE.vdb|REGION", "more faces in places, fewer in others"}, options.density);
    visit(OptionInfo{"joints", "FILE", "rings of quads where it is to bend"}, options.joints);
    visit(OptionInfo{"smooth", "K", "rounds it off: 0 is tightest", BoundingSmoothOptions::sweepCounts},
          options.smooth);
    visit(OptionInfo{"parts", "", "separate parts of the closing", {}, true}, options.parts);
    visit(OptionInfo{"least-part", "F", "leaves smaller parts of the model out", {0, 1}, true}, options.leastPart);
    visit(OptionInfo{"mesh", "", "faces of the cage"}, options.mesh);
    visit(OptionInfo{"quad-shape", "F", "0: tightest, 1: squarest quads", BoundingTriquadOptions::quadShapes},
          options.quadShape);
    visit(OptionInfo{"merge-angle", "DEG", "largest fold of a quad", BoundingTriquadOptions::mergeAngles, true},
          options.mergeAngle);
    visit(OptionInfo{"symmetry", "", "symmetric cages of symmetric models"}, options.symmetry);
    visit(OptionInfo{"symmetry-tolerance", "F", "how symmetric models are", {0, 0.3}, true}, options.symmetryTolerance);
    visit(OptionInfo{"interior", "", "open models are solids, or shells"}, options.interior);
    visit(OptionInfo{"voxelizer", "", "voxelizes by CPU, OpenGL or CGAL", {}, true}, options.voxelizer);
    visit(OptionInfo{"bounding", "", "only ever a certified cage", {}, true}, options.bounding);
    visit(OptionInfo{"clearance", "F", "least distance to model", GuardOptions::clearances, true}, options.clearance);
    visit(OptionInfo{"min-angle", "DEG", "floor for triangle angles", GuardOptions::minAngles, true}, options.minAngle);
    visit(OptionInfo{"precision", "", "numbers that coordinates are", {}, true}, options.precision);
    visit(OptionInfo{"effort", "", "time against tightness"}, options.effort);
}

/// An option in words, for help and tables.
struct OptionText {
    std::string name;         ///< as OptionInfo
    std::string value;        ///< "N", "F", "sphere|cube"
    std::string help;         ///< as OptionInfo
    std::string range;        ///< "4 to 1000000"; empty for names out of a list
    std::string defaultValue; ///< "400"
    bool isRare = false;      ///< as OptionInfo
};

/// Returns all options in words, in the order of visitOptions().
VDBCAGE_API std::vector<OptionText> describeOptions();

/// Returns the name and the value of each option as text, in the order of visitOptions(). setOption() takes all values
/// except "given": that of a field, or of joints, that were not read from text or a file.
/// \param options any
VDBCAGE_API std::vector<std::pair<std::string, std::string>> optionValues(const CageOptions& options);

/// Sets an option from text. Files that it names are read.
/// \param options only the named one changes; whether options fit each other is left to requireValid()
/// \param name OptionInfo::name
/// \param value numbers are written in the C locale's way
/// \throw InputError when there is no such option, or the value is not allowed; names the option, the value and the
/// allowed values
/// \throw IoError when a file cannot be read; names it
VDBCAGE_API void setOption(CageOptions& options, const std::string& name, const std::string& value);

/// Returns the fewest faces that may be asked for: 4 of triangles (a tetrahedron), 6 of all others (a box).
/// \param mesh the faces that the cage is made of
VDBCAGE_API int leastFaces(CageFaces mesh);

/// Checks every range and that options fit each other.
/// \param options any
/// \throw InputError when a value is not allowed; names the option, the value and the allowed values
VDBCAGE_API void requireValid(const CageOptions& options);

} // namespace vdbcage
