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

/// The policy of the search for a cage: pure functions of the options and of the results so far.
namespace vdbcage::detail {

/// All constants of policy: they decide where the options leave a choice.
///
/// Where one was measured, its comment has the cost of other values. `vdbcage-bench cage` and plain `vdbcage-bench`
/// measure it again.
namespace policy {

// Voxels. The surface should have several times as many faces as the cage; still more gain little.
constexpr int usualResolution = 64;    ///< voxels along the longest side, for up to `usualFaces` and Effort::best
constexpr double usualFaces = 1000;    ///< beyond, the resolution grows with the root of the faces
constexpr int finestResolution = 512;  ///< that is chosen; finer ones must be asked for
constexpr int coarsestResolution = 16; ///< no entry of a ladder is below
constexpr double shareFast = 2.0 / 3, shareFair = 5.0 / 6; ///< of the resolution, for time (docs/dev/BENCHMARKS.md)
constexpr int hullResolution = 32;                         ///< a hull has no detail that more could show
constexpr double leastRadius = 0.03;                       ///< of a closing, of the longest side
constexpr double greatestRadius = 0.24;                    ///< after three doublings; the option's range ends at 0.25

// Where a speck far away takes most of the longest side, voxels and radii are fractions of the share that the rest
// fills.
constexpr double fewestTriangles = 3;  ///< of the surface, for each face of the cage; most models have 6 and more
constexpr double usualTriangles = 8;   ///< the same number, for which voxels are then made finer
constexpr double mostVoxels = 1 << 30; ///< of the bounding box, a bit each in voxelizers

// Loops of quads begin with the quads of coarse voxels, several times as many as are wanted.
constexpr double loopsResolution =
    1.2; ///< voxels along the longest side, times the root of the faces; then adapted to the surface
constexpr double quadsPerLoopsFace = 3;
constexpr int coarsestLoops = 8;                                                   ///< voxels along the longest side
constexpr int loopExchangesFast = 1, loopExchangesFair = 4, loopExchangesBest = 8; ///< 4 gain 3 %, in a third more time
constexpr double worthTurning = 0.95; ///< share of the voxels' surface; if other axes have less, loops also begin there
constexpr double loopsStarts[] = {1.0, 1.35}, bestLoopsStarts[] = {0.85, 1.0, 1.2, 1.4}; ///< shares of the resolution

// Surfaces.
constexpr double enoughTriangles = 9000; ///< for up to `usualFaces` and Effort::fast; with 7500 some are 8 % looser
constexpr double coarsestShare = 0.75;   ///< of the resolution to have no more: thin parts need some
constexpr std::size_t largeSurface = 500'000; ///< faces: beyond, one after the other and not recorded, for memory
constexpr double partsAndTunnelsShare = 0.15; ///< of the faces, that parts and tunnels may take
constexpr double facesPerPart = 8, facesPerTunnel = 12; ///< about the least that one takes

// Starts. Among few faces the order of the collapses is luck, so several starts pay. For the fewest, voxels of up to
// twice the width are as good, and two starts with these take hardly more time than one without.
constexpr int fewFaces = 200, fewestFaces = 60;
constexpr int competingFaces = 150; ///< up to this number, lower efforts' cages and tightened boxes compete
constexpr int competingLoops = 24;  ///< up to this number, loops compete with other quads; they take longer
constexpr double fewStarts[] = {1.0, 0.85, 0.7, 0.6}, fewestStarts[] = {0.65, 0.5}; ///< shares of the resolution

constexpr double unevenness = 15;     ///< largest distance over the mean; 6 to 12 on models that are not flat
constexpr double nearlyOn = 10;       ///< mean distance in clearances, below which the cage lies on the model
constexpr double nearlyOnFaces = 30;  ///< the same, for models of fewer faces than the cage
constexpr double fewestUneven = 12.5; ///< faces; then twice as many, and so on
constexpr double muchTighter = 0.8;   ///< of the mean distance with a share of the largest

// Finer voxels can be worse: they leave gaps open, whose tunnels take faces. Coarser ones therefore compete with those
// that are given, and with others where there are tunnels, which is 5 % tighter on 30 models of that kind. That takes
// twice the processor time, but in parallel little longer.
constexpr int coarsestHalf = 24; ///< voxels along the longest side

// Shape of the cage.
constexpr double mergeAnyFold = 90, mergeFlat = 10, mergeUsual = 30; ///< degrees: quads, no guard, triquad
constexpr double wideAngle = 10, usualAngle = 6; ///< degrees; the wide one costs up to 5 % of the tightness
constexpr double loopsAngle = 1;                 ///< degrees; with more, slender triangles stop half collapsed loops
// Sheets, which have no inside. Their cages are flat, and as loose as the spacing of their two sides: three times as
// loose with that of other cages.
constexpr int sheetResolution = 54;  ///< voxels along the longest side, for the test: as usual with Effort::fair
constexpr double sheetInside = 0.01; ///< share of the voxels with others all around, at most
constexpr double sheetWidth = 20;    ///< voxels for each along the longest side, at least; a rod as thin has up to 12
constexpr double sheetAngle = 1;     ///< degrees: slender triangles along the rim
constexpr double sheetSpacing = 2.5e-4;
constexpr double mostlyQuads = 0.875;
///< of the faces; more cost a third of the tightness on models with edges
constexpr std::size_t trianglesPerQuad = 3;       ///< at first: two a quad, and some that vanish; 2 to 4 are alike
constexpr int symmetricPerturbations = 3;         ///< times as many, in the time that half a surface saves
constexpr double largestRequestedDeviation = 0.3; ///< of a plane across a given axis; beyond, it is no symmetry
constexpr double leastTurnedSide = 0.05;          ///< world units: OpenVDB has no turned voxels below 1.44e-5
constexpr double boxMargin = 0.01;                ///< of the longest side, between the model and its box
constexpr double leastThickness = 0.005; ///< of a box, over its longest side: the guard keeps surfaces 0.002 apart
constexpr int usualSmoothing = 3;        ///< sweeps that remove the steps of the voxels, where there is no guard

} // namespace policy

/// Returns whether a box has more faces than the options allow.
inline bool isBoxTooMuch(const CageOptions& options)
{
    constexpr int trianglesOfBox = 12;
    return options.mesh == CageFaces::triangles && options.faces < trianglesOfBox;
}

/// The values of the voxels' options, with `auto` resolved.
struct Voxels {
    int resolution = 0;
    double closeRadius = 0;
    std::optional<SymmetryPlane> plane = {}; ///< across the middle of the voxels: the index resolution / 2
    bool turned = false;                     ///< along the model's own axes
};

/// Returns the options whose cages compete for the tightest. Among few faces the order of the collapses is luck:
/// there they include those of all lower efforts, so that no effort makes looser cages than a lower one. Among the
/// fewest, loops compete with other quads from Effort::fair on.
std::vector<CageOptions> competitors(const CageOptions& options);

/// Returns the share of the longest side to which options `auto` of the voxels refer. It is 1, or less where the
/// surface in such voxels has too few faces for the cage and all parts are small: a power of 1/2, not below the largest
/// part, and not so small that voxels take too much memory.
/// `quadsOf` returns the number of quads of the closing's surface in some voxels.
/// \throw the exceptions of `quadsOf`
double shareOfSide(const CageOptions& options, const Mesh& model,
                   const std::function<std::size_t(const Voxels&)>& quadsOf);
/// Returns whether a cage may have more faces than help on a flat model: some places are much farther away than most,
/// or the cage lies on the model. Among few faces, where lower efforts compete, only if the model itself has at most as
/// many faces.
bool mayFewerBeTighter(const CageOptions& options, const CageCheck& check, std::size_t modelFaces);
/// Returns the options with fewer faces, whose cages may be tighter then: the fewest first, in the same steps for all
/// counts.
std::vector<CageOptions> fewerFaces(const CageOptions& options);
/// Returns whether a cage of more faces is preferred: it is nowhere looser, or much tighter as a whole.
bool areWorthTheirFaces(const CageCheck& more, const CageCheck& fewer, double clearance);

/// Returns the voxels to try: one ladder for the finest, and one for each of its halves. Options that are not `auto`
/// are obeyed.
///
/// The first entry of each ladder that leads to few enough parts and tunnels is taken. That of the first ladder
/// competes with those of the others if mayCoarserBeTighter().
std::vector<std::vector<Voxels>> ladders(const CageOptions& options, double share = 1);

/// Returns the first entry of the first ladder.
Voxels finestVoxels(const CageOptions& options, double share = 1);

/// Returns whether halves of the resolution are worth their time. A given resolution always competes with them, so that
/// twice that resolution is never looser. Others do where gaps stay open or needed a greater radius. `finest` is the
/// entry taken from the first ladder, `topology` that of its surface.
bool mayCoarserBeTighter(const CageOptions& options, double share, const Voxels& finest, const MeshTopology& topology);

/// Returns whether pairs of triangles become quads.
bool arePaired(const CageOptions& options);

/// Returns whether cages of other kinds compete with those from closings: a box's, and those of lower efforts.
bool isOfFewFaces(const CageOptions& options);

/// Returns the shares of a resolution with which cages are begun, to take the tightest.
std::vector<double> startScales(const CageOptions& options);

/// Returns whether cages are also begun with voxels along the model's own axes, where these are better.
bool mayBeTurned(const CageOptions& options);

/// Returns whether the resolution depends on the size of the surface, which the longest side hardly predicts.
bool dependsOnSurface(const CageOptions& options);
/// Returns the resolution of `voxels`, or a coarser one where their surface of `quads` quads is larger than helps the
/// cage. For loops returns the resolution that makes the quads with which they begin; it may be finer.
/// \pre dependsOnSurface()
int affordableResolution(const CageOptions& options, double share, const Voxels& voxels, std::size_t quads);

/// Returns whether parts and tunnels leave enough faces for the shape.
bool leavesFacesForShape(const CageOptions& options, const MeshTopology& topology);

/// Returns the number of sweeps of smoothing.
int smoothing(const CageOptions& options);

/// Returns the number of rounds in which loops are exchanged.
int loopExchanges(Effort effort);

/// Returns the angle in degrees. \pre the options ask for quads
double mergeAngle(const CageOptions& options);

/// Returns the shortest side that a box may have, over its longest. The smallest angle and the spacing of surfaces
/// limit it.
double thinnestBox(const GuardOptions& guarding);

/// Returns whether a solid of `voxels` voxels is a sheet: hardly any of them have others all around, and they are too
/// many for a rod. `resolution` is the number of voxels along the longest side.
bool isSheet(std::size_t voxels, std::size_t inner, int resolution);

/// Returns the guard's options, without a plane of symmetry. `ofSheet`: of a model that isSheet.
GuardOptions guardOptions(const CageOptions& options, bool ofSheet);

/// Returns the density at joints.
double jointDensity(const CageOptions& options);

} // namespace vdbcage::detail
