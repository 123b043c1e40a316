#include <vdbcage/pipeline/detail/search_policy.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/mesh/parts.h>

namespace vdbcage::detail {

using namespace policy;

namespace {

double shareOf(Effort effort)
{
    return effort == Effort::fast ? shareFast : effort == Effort::fair ? shareFair : 1.0;
}

double growth(const CageOptions& options)
{
    return std::max(1.0, options.faces / usualFaces);
}

/// Returns the entries of one resolution, with all radii.
std::vector<Voxels> entriesOf(int resolution, const std::optional<double>& closeRadius, double share)
{
    std::vector<Voxels> list{{resolution, closeRadius.value_or(leastRadius * share)}};
    if (!closeRadius) {
        for (double radius = 2 * leastRadius; radius <= greatestRadius; radius *= 2) {
            list.push_back({resolution, radius * share});
        }
    }
    return list;
}

} // namespace

bool arePaired(const CageOptions& options)
{
    return options.mesh == CageFaces::triquad || options.mesh == CageFaces::quads;
}

bool isOfFewFaces(const CageOptions& options)
{
    return options.faces <= competingFaces;
}

std::vector<CageOptions> competitors(const CageOptions& options)
{
    std::vector<CageOptions> list;
    for (const Effort effort : {Effort::fast, Effort::fair, Effort::best}) {
        const bool isLower = effort < options.effort;
        if (effort != options.effort && !(isLower && isOfFewFaces(options))) continue;
        list.push_back(options);
        list.back().effort = effort;
    }
    if (arePaired(options) && options.effort != Effort::fast && options.faces <= competingLoops) {
        list.push_back(options);
        list.back().effort = Effort::fast;
        list.back().mesh = CageFaces::loops;
    }
    return list;
}

bool mayFewerBeTighter(const CageOptions& options, const CageCheck& check, std::size_t modelFaces)
{
    const bool hasModelFewer = modelFaces <= static_cast<std::size_t>(options.faces);
    if (isOfFewFaces(options) && !hasModelFewer) return false;
    const double near = (hasModelFewer ? nearlyOnFaces : nearlyOn) * options.clearance;
    return check.maxDistance > unevenness * check.meanDistance || check.meanDistance < near;
}

std::vector<CageOptions> fewerFaces(const CageOptions& options)
{
    std::vector<CageOptions> list;
    if (options.mesh == CageFaces::loops) return list;
    for (double faces = fewestUneven; faces < options.faces; faces *= 2) {
        list.push_back(options);
        list.back().faces = static_cast<int>(faces);
    }
    return list;
}

bool areWorthTheirFaces(const CageCheck& more, const CageCheck& fewer, double clearance)
{
    const auto unevenDistance = [](const CageCheck& c) { return c.meanDistance + c.maxDistance / unevenness; };
    const bool isNowhereLooser =
        more.meanDistance <= fewer.meanDistance + clearance && more.maxDistance <= fewer.maxDistance + clearance;
    return isNowhereLooser || unevenDistance(more) < muchTighter * unevenDistance(fewer);
}

double shareOfSide(const CageOptions& options, const Mesh& model,
                   const std::function<std::size_t(const Voxels&)>& quadsOf)
{
    if (options.resolution) return 1;
    const openvdb::BBoxd bounds = boundingBox(model);
    const double side = longestSide(bounds);
    const openvdb::Vec3d extents = bounds.extents() / side;
    const double box = extents[0] * extents[1] * extents[2];
    std::optional<double> largest; // the largest part, once it is needed
    CageOptions countedOptions = options;
    if (options.mesh == CageFaces::loops) countedOptions.mesh = CageFaces::quads; // voxels of loops follow the surface
    for (double share = 1;; share /= 2) {
        Voxels voxels = finestVoxels(countedOptions, share);
        const double finer = 2.0 * voxels.resolution;
        voxels.resolution = static_cast<int>(std::lround(startScales(countedOptions).front() * voxels.resolution));
        if (finer > CageOptions::resolutions.most || box * finer * finer * finer > mostVoxels) return share;
        const double triangles = 2 * static_cast<double>(quadsOf(voxels));
        if (triangles >= (share == 1 ? fewestTriangles : usualTriangles) * options.faces) return share;
        if (!largest) largest = largestPart(model) / side;
        if (share / 2 < *largest) return share;
    }
}

std::vector<std::vector<Voxels>> ladders(const CageOptions& options, double share)
{
    const bool areLoops = options.mesh == CageFaces::loops;
    const double wantedResolution = areLoops ? loopsResolution * std::sqrt(options.faces)
                                             : shareOf(options.effort) * usualResolution * std::sqrt(growth(options));
    int resolution = options.resolution.value_or(
        std::clamp(static_cast<int>(std::ceil(wantedResolution)), coarsestLoops, finestResolution));
    const auto finer = [share](int voxels) { return static_cast<int>(std::lround(voxels / share)); };
    if (!options.resolution) resolution = finer(resolution);
    std::vector<std::vector<Voxels>> list{entriesOf(resolution, options.closeRadius, share)};
    if (options.resolution || !areLoops) {
        while (resolution / 2 >= finer(coarsestHalf)) {
            list.push_back(entriesOf(resolution /= 2, options.closeRadius, share));
        }
    }
    if (!options.resolution) {
        const int coarsest = areLoops ? coarsestLoops : coarsestResolution;
        for (int coarser = resolution / 2; coarser >= coarsest; coarser /= 2) {
            list.back().push_back({coarser, options.closeRadius.value_or(greatestRadius)});
        }
    }
    return list;
}

Voxels finestVoxels(const CageOptions& options, double share)
{
    return ladders(options, share).front().front();
}

bool mayCoarserBeTighter(const CageOptions& options, double share, const Voxels& finest, const MeshTopology& topology)
{
    const bool isRadiusRaised = finest.closeRadius > options.closeRadius.value_or(leastRadius * share);
    return options.resolution || isRadiusRaised || topology.components() > 1 || topology.genus() > 0;
}

std::vector<double> startScales(const CageOptions& options)
{
    if (options.resolution) return {1.0};
    if (options.mesh == CageFaces::loops) {
        if (options.effort == Effort::fast) return {1.0};
        if (options.effort == Effort::best) return {std::begin(bestLoopsStarts), std::end(bestLoopsStarts)};
        return {std::begin(loopsStarts), std::end(loopsStarts)};
    }
    if (options.effort != Effort::best && options.faces <= fewestFaces)
        return {std::begin(fewestStarts), std::end(fewestStarts)};
    if (options.effort == Effort::best && options.faces <= fewFaces)
        return {std::begin(fewStarts), std::end(fewStarts)};
    return {1.0};
}

bool mayBeTurned(const CageOptions& options)
{
    // Places of a scale are along x, y and z.
    return options.mesh == CageFaces::loops && !options.resolution && options.scale.isNone();
}

bool dependsOnSurface(const CageOptions& options)
{
    if (options.resolution) return false;
    return options.mesh == CageFaces::loops || (options.effort == Effort::fast && options.faces > fewestFaces);
}

int affordableResolution(const CageOptions& options, double share, const Voxels& voxels, std::size_t quads)
{
    if (options.mesh == CageFaces::loops) {
        const double factor = std::sqrt(quadsPerLoopsFace * options.faces / static_cast<double>(quads));
        return std::clamp(static_cast<int>(std::lround(factor * voxels.resolution)), coarsestLoops,
                          static_cast<int>(std::lround(finestResolution / std::max(share, 0.25))));
    }
    const double triangles = 2 * static_cast<double>(quads);
    const double factor = std::sqrt(enoughTriangles * growth(options) / triangles);
    return static_cast<int>(std::lround(std::clamp(factor, coarsestShare, 1.0) * voxels.resolution));
}

bool leavesFacesForShape(const CageOptions& options, const MeshTopology& topology)
{
    const auto parts = static_cast<double>(topology.components());
    if (options.parts == CageParts::merge && parts > 1) return false;
    const double takenFaces = facesPerPart * (parts - 1) + facesPerTunnel * static_cast<double>(topology.genus());
    return takenFaces <= partsAndTunnelsShare * options.faces;
}

int smoothing(const CageOptions& options)
{
    return options.smooth.value_or(options.bounding ? 0 : usualSmoothing);
}

int loopExchanges(Effort effort)
{
    return effort == Effort::fast ? loopExchangesFast : effort == Effort::fair ? loopExchangesFair : loopExchangesBest;
}

double mergeAngle(const CageOptions& options)
{
    const double automatic = options.mesh == CageFaces::quads ? mergeAnyFold
                             : options.bounding               ? mergeUsual
                                                              : mergeFlat;
    return options.mergeAngle.value_or(automatic);
}

double thinnestBox(const GuardOptions& guarding)
{
    constexpr double degree = pi / 180, room = 1.001;
    return std::max(leastThickness, room * std::tan(degree * guarding.minAngleDegrees));
}

bool isSheet(std::size_t voxels, std::size_t inner, int resolution)
{
    const auto all = static_cast<double>(voxels);
    return static_cast<double>(inner) <= sheetInside * all && all >= sheetWidth * resolution;
}

GuardOptions guardOptions(const CageOptions& options, bool ofSheet)
{
    // Cages that compete are made under one guard.
    const bool isWide =
        options.mesh == CageFaces::triangles && options.effort == Effort::fair && !isOfFewFaces(options);
    GuardOptions guarding;
    guarding.clearance = options.clearance;
    guarding.precision = options.precision;
    const bool areSlenderAllowed = ofSheet || options.mesh == CageFaces::loops;
    guarding.minAngleDegrees = options.minAngle.value_or(!areSlenderAllowed ? (isWide ? wideAngle : usualAngle)
                                                         : ofSheet          ? sheetAngle
                                                                            : loopsAngle);
    if (ofSheet) guarding.spacing = sheetSpacing;
    return guarding;
}

double jointDensity(const CageOptions& options)
{
    return options.mesh == CageFaces::loops ? 1 : FaceWishOptions{}.jointDensity;
}

} // namespace vdbcage::detail
