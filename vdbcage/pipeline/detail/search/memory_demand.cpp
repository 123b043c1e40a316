#include <vdbcage/pipeline/detail/search/memory_demand.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/pipeline/detail/search/search_plan.h>
#include <vdbcage/pipeline/memory.h>

namespace vdbcage::detail {

namespace {

// Bytes, fitted to the peaks of runs with two threads, so that nearly all took less; docs/user/OPTIONS.md has figures.
constexpr double perProcess = 60e6;      ///< the program and its libraries
constexpr double perOpenGl = 80e6;       ///< with the driver's
constexpr double perModelTriangle = 400; ///< of the mesh, the guard and the certifier
constexpr double perPlainTriangle = 250; ///< where there is no guard
constexpr double perQuad = 2200;         ///< of the surface, under the guard, with the record of its decimation
constexpr double perLargeQuad = 800;     ///< without that record (largeSurface)
constexpr double perPlainQuad = 600;     ///< of the surface, where there is no guard
constexpr double perCageFace = 1500;     ///< of the cage, with the data for its tightening
constexpr double perVoxel = 0.2;         ///< of the bounding box
constexpr int countedResolution = 64;    ///< finer voxels add less than a third to the surface, mostly nothing

std::string sizeText(double bytes)
{
    constexpr double mebibyte = 1024.0 * 1024, gibibyte = 1024 * mebibyte;
    char text[32];
    if (bytes < gibibyte) {
        std::snprintf(text, sizeof text, "%.0f MiB", std::ceil(bytes / mebibyte));
    } else {
        std::snprintf(text, sizeof text, "%.1f GiB", bytes / gibibyte);
    }
    return text;
}

} // namespace

MemoryDemand::MemoryDemand(const Mesh& model, const CageOptions& options, double share,
                           const std::function<std::size_t(const Voxels&)>& quadsOf)
    : options_(options),
      modelTriangles_(static_cast<double>(model.triangles.size() + 2 * model.quads.size() + model.alternatives.size())),
      share_(share)
{
    const openvdb::BBoxd box = boundingBox(model);
    Voxels voxels = finestVoxels(options, share_);
    voxels.resolution = std::min(voxels.resolution, static_cast<int>(countedResolution / share_));
    const double side = voxels.resolution;
    quads_ = static_cast<double>(quadsOf(voxels)) / (side * side);
    for (const int axis : {0, 1, 2}) box_ *= box.extents()[axis] / longestSide(box) + 1 / side;
}

double MemoryDemand::bytes(int resolution) const
{
    CageOptions options = options_;
    if (resolution > 0) options.resolution = resolution;
    double together = 0, alone = 0; // bytes of surfaces: side by side, and of the one that alone takes most
    double finest = 0;              // resolution
    const auto add = [&](double quads, const CageOptions& competitor) {
        const double recorded = quads * (competitor.bounding ? perQuad : perPlainQuad);
        if (!competitor.bounding || quads <= policy::largeSurface) {
            together += recorded;
        } else {
            alone = std::max(alone, competitor.mesh == CageFaces::loops ? recorded : quads * perLargeQuad);
        }
    };
    for (const SearchPlan::Competitor& competitor : searchPlan(options, share_).competitors) {
        const CageOptions& competitorOptions = competitor.options;
        const bool areLoops = competitorOptions.mesh == CageFaces::loops && !competitorOptions.resolution;
        for (const std::vector<Voxels>& ladder : competitor.ladders) {
            const int ladderResolution = ladder.front().resolution;
            const double first = areLoops ? policy::quadsPerLoopsFace * competitorOptions.faces
                                          : quads_ * static_cast<double>(ladderResolution) * ladderResolution;
            if (competitor.mayBeTurned) add(first, competitorOptions);
            for (const double scale : competitor.startScales) {
                add(first * scale * scale, competitorOptions);
                finest = std::max(finest, scale * ladderResolution);
            }
        }
    }
    const double voxels = perVoxel * box_ * finest * finest * finest;
    return perProcess + (options.voxelizer == Voxelizer::gl ? perOpenGl : 0) +
           modelTriangles_ * (options.bounding ? perModelTriangle : perPlainTriangle) + perCageFace * options.faces +
           std::max({together, alone, voxels});
}

/// Returns the finest resolution, below that of the options, with at most `limit` bytes; 0 if there is none.
int MemoryDemand::finestWithin(double limit) const
{
    constexpr auto least = static_cast<int>(CageOptions::resolutions.least);
    int fits = finestVoxels(options_, share_).resolution - 1;
    while (fits >= least && bytes(fits) > limit) --fits; // larger surfaces may take less: they are not recorded
    return fits >= least ? fits : 0;
}

void MemoryDemand::requireWithin(std::size_t limit) const
{
    const auto allowed = static_cast<double>(limit);
    if (bytes() <= allowed) return;
    const int finest = finestWithin(allowed);
    const std::string resolution = options_.resolution ? std::to_string(*options_.resolution) : "auto";
    throw MemoryError("--resolution: '" + resolution + "' would take about " + sizeText(bytes()) + " of memory, and " +
                      sizeText(allowed) + " is allowed; " +
                      (finest > 0 ? "with " + std::to_string(finest) + " it would fit" : "no resolution would fit"));
}

} // namespace vdbcage::detail
