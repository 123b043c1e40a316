#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/check/check.h>
#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/pipeline/options.h>

/// The policy of the search for a cage. These are pure functions of the options and of what was found
/// so far.
namespace vdbcage::detail {

/// Every constant of policy: they decide what the options leave to us.
///
/// Where one was measured, its comment says what others cost. `vdbcage-bench cage` and plain `vdbcage-bench` measure
/// it again.
namespace policy {

// Voxels. The surface should have several times the faces that the cage is to have; still more gain little.
constexpr int usualResolution = 64;    ///< voxels along the longest side, for up to `usualFaces` and Effort::best
constexpr double usualFaces = 1000;    ///< beyond, the resolution grows with the root of the faces
constexpr int finestResolution = 512;  ///< that is chosen; finer ones have to be asked for
constexpr int coarsestResolution = 16; ///< no rung of the ladder is below
constexpr double shareFast = 2.0 / 3, shareFair = 5.0 / 6; ///< of the resolution, for time (docs/dev/BENCHMARKS.md)
constexpr int hullResolution = 32;                         ///< a hull has no detail that more could show
constexpr double leastRadius = 0.03;                       ///< of a closing, of the longest side
constexpr double greatestRadius = 0.24;                    ///< after three doublings; the option's range ends at 0.25

// Where a speck far away takes most of the longest side, voxels and radii are of the share that the rest of it fills.
constexpr double fewestTriangles = 3;  ///< of the surface, for a face of the cage; of most models 6 and more
constexpr double usualTriangles = 8;   ///< that voxels are then made finer for
constexpr int mostResolution = 2048;   ///< as can be asked for
constexpr double mostVoxels = 1 << 30; ///< of the bounding box, a bit each in voxelizers

// Loops of quads begin with the quads of coarse voxels, some times as many as are wanted.
constexpr double loopsResolution =
    1.2; ///< voxels along the longest side, for the root of a face; then as the surface has
constexpr double quadsPerLoopsFace = 3;
constexpr int coarsestLoops = 8;                                                   ///< voxels along the longest side
constexpr int loopExchangesFast = 1, loopExchangesFair = 4, loopExchangesBest = 8; ///< 4 gain 3 %, in a third more time
constexpr double worthTurning = 0.95; ///< of the surface of voxels, that along other axes: loops begin along these too
constexpr double loopsStarts[] = {1.0, 1.35}, bestLoopsStarts[] = {0.85, 1.0, 1.2, 1.4}; ///< shares of the resolution

// Surfaces.
constexpr double enoughTriangles = 9000; ///< for up to `usualFaces` and Effort::fast; with 7500 some are 8 % looser
constexpr double coarsestShare = 0.75;   ///< of the resolution to have no more: thin parts need some
constexpr std::size_t largeSurface = 500'000; ///< faces: beyond, one after the other and not recorded, for memory
constexpr double handleShare = 0.15;          ///< of the faces, that parts and handles may take
constexpr double facesPerPart = 8, facesPerHandle = 12; ///< that one takes at least, about

// Starts. Among few faces the order of the collapses is luck, so that several starts pay. For the fewest, voxels of up
// to twice the width are as good, and two starts with these take hardly more time than one without.
constexpr int fewFaces = 200, fewestFaces = 60;
constexpr int competingFaces = 150; ///< up to these, lower efforts' cages and tightened boxes compete
constexpr int competingLoops = 24;  ///< up to so many faces, loops with other quads; they take longer
constexpr double fewStarts[] = {1.0, 0.85, 0.7, 0.6}, fewestStarts[] = {0.65, 0.5}; ///< shares of the resolution

constexpr double unevenness = 15;     ///< largest distance over the mean; 6 to 12 on models that are not flat
constexpr double nearlyOn = 10;       ///< clearances, of the mean distance
constexpr double nearlyOnFaces = 30;  ///< the same, for models of fewer faces than the cage
constexpr double fewestUneven = 12.5; ///< faces, then twice as many and so on
constexpr double muchTighter = 0.8;   ///< of the mean distance with a share of the largest

// Finer voxels can be worse: they leave gaps open, whose handles take faces. So coarser ones compete with those that
// are given, and with others where there are handles: 5 % tighter on 30 models of that kind. That takes twice the
// processor's time, but side by side little longer.
constexpr int coarsestHalf = 24; ///< voxels along the longest side

// Shape of the cage.
constexpr double mergeAnyFold = 90, mergeFlat = 10, mergeUsual = 30; ///< degrees: quads, no guard, triquad
constexpr double wideAngle = 10, usualAngle = 6; ///< degrees; the wide one costs up to 5 % of the tightness
constexpr double loopsAngle = 1; ///< degrees; with more, half collapsed loops are stopped by their slender triangles
// Sheets, which have no inside. Their cages are flat, and as loose as their two sides keep apart: three times as loose
// with what others keep.
constexpr int sheetResolution = 54;  ///< voxels along the longest side, to tell: as usual with Effort::fair
constexpr double sheetInside = 0.01; ///< of the voxels, at most
constexpr double sheetWidth = 20;    ///< voxels for each along the longest side, at least; a rod as thin has up to 12
constexpr double sheetAngle = 1;     ///< degrees: slender triangles along the rim
constexpr double sheetSpacing = 2.5e-4;
constexpr double mostlyQuads = 0.875;
///< of the faces; more cost a third of the tightness on models with edges
constexpr std::size_t trianglesPerQuad = 3;       ///< to begin with: two a quad, and some that vanish; 2 to 4 are alike
constexpr int symmetricPerturbations = 3;         ///< times as many, in the time that half a surface saves
constexpr double largestRequestedDeviation = 0.3; ///< of a plane across a given axis: more is no symmetry
constexpr double leastTurnedSide = 0.05;          ///< world units: OpenVDB has no turned voxels below 1.44e-5
constexpr int trianglesOfBox = 12;
constexpr double boxMargin = 0.01;       ///< of the longest side, between the model and its box
constexpr double leastThickness = 0.005; ///< of its longest side, of a box: the guard keeps surfaces 0.002 apart
constexpr int usualSmoothing = 3;        ///< sweeps that take the steps of the voxels away, where no guard does

} // namespace policy

/// The values that the options `auto` of the voxels stand for.
struct Voxels {
    int resolution = 0;
    double closeRadius = 0;
    std::optional<SymmetryPlane> plane = {}; ///< across the middle of the voxels: the index resolution / 2
    bool turned = false;                     ///< along the model's own axes
};

/// The options whose cages compete for the tightest, Among few faces the order of the collapses is luck: there they are
/// those of all lower efforts, too, so that no effort gives looser cages than a lower one. Among the fewest, loops
/// compete with other quads from Effort::fair on.
std::vector<CageOptions> competitors(const CageOptions& options);

/// The share of the longest side that options `auto` of the voxels are fractions of. It is 1, or less where the surface
/// in such voxels has too few faces for the cage and all parts are small: a power of 1/2, not below the largest part,
/// nor so small that voxels take too much memory.
/// `quadsOf` gives the number of quads of the closing's surface in some voxels.
/// \throw what `quadsOf` throws
double shareOfSide(const CageOptions& options, const Mesh& model,
                   const std::function<std::size_t(const Voxels&)>& quadsOf);
/// Whether a cage may have more faces than a flat model has a use for: some places are much farther away than most, or
/// it lies on the model. Among few faces, where lower efforts compete, only of models that have fewer faces themselves.
bool mayFewerBeTighter(const CageOptions& options, const CageCheck& check, std::size_t modelFaces);
/// The options with fewer faces, whose cages may be tighter then: the fewest first, and the same for all counts that
/// have more.
std::vector<CageOptions> fewerFaces(const CageOptions& options);
/// Whether a cage of more faces is to be preferred: it is nowhere looser, or much tighter as a whole.
bool areWorthTheirFaces(const CageCheck& more, const CageCheck& fewer, double clearance);

/// The voxels to try: one ladder for the finest, and one for each of its halves. Options that are not `auto` are
/// obeyed.
///
/// Of each ladder the first rung that leads to few enough handles is taken; that of the first ladder competes with
/// those of the others where mayCoarserBeTighter().
std::vector<std::vector<Voxels>> ladders(const CageOptions& options, double share = 1);

/// The first rung of the first ladder.
Voxels finestVoxels(const CageOptions& options, double share = 1);

/// Whether halves of the resolution are worth their time. A resolution that is given always competes with them, so that
/// twice of it is never looser. Others do where gaps stay open or needed a greater radius. `finest` is the rung taken
/// from the first ladder, `topology` that of its surface.
bool mayCoarserBeTighter(const CageOptions& options, double share, const Voxels& finest, const MeshTopology& topology);

/// Whether pairs of triangles become quads.
bool arePaired(const CageOptions& options);

/// Whether cages of other kinds compete with those from closings: a box's, and those of lower efforts.
bool isOfFewFaces(const CageOptions& options);

/// The shares of a resolution that cages are begun with, to take the tightest.
std::vector<double> startScales(const CageOptions& options);

/// Whether cages are also begun with voxels along the model's own axes, where these are better.
bool mayBeTurned(const CageOptions& options);

/// Whether the resolution depends on how large the surface is, which the longest side tells little of.
bool dependsOnSurface(const CageOptions& options);
/// The resolution of `voxels`, or a coarser one where their surface of `quads` quads is larger than the cage gains
/// from; of loops that which gives the quads they begin with, which may be finer. \pre dependsOnSurface()
int affordableResolution(const CageOptions& options, double share, const Voxels& voxels, std::size_t quads);

/// Whether parts and handles leave faces enough for the shape.
bool hasFewEnoughHandles(const CageOptions& options, const MeshTopology& topology);

/// Sweeps of smoothing.
int smoothing(const CageOptions& options);

/// How often loops are exchanged.
int loopExchanges(Effort effort);

/// Degrees. \pre the options ask for quads
double mergeAngle(const CageOptions& options);

/// The shortest side that a box may have, fraction of its longest: for the smallest angle, and since surfaces keep off
/// themselves.
double thinnestBox(const GuardOptions& guarding);

/// Whether a solid of so many voxels is a sheet: hardly any of them have others all around, and they are too many for a
/// rod. `resolution` is the number of voxels along the longest side.
bool isSheet(std::size_t voxels, std::size_t inner, int resolution);

/// Without a plane of symmetry. `ofSheet`: of a model that isSheet.
GuardOptions guardOptions(const CageOptions& options, bool ofSheet);

/// The density at joints.
double jointDensity(const CageOptions& options);

} // namespace vdbcage::detail
