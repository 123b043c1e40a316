#include <vdbcage/pipeline/memory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <vdbcage/mesh/parts.h>
#include <vdbcage/pipeline/detail/search.h>
#include <vdbcage/pipeline/detail/simple_solids.h>
#include <vdbcage/pipeline/detail/volumes.h>

namespace vdbcage {

namespace {

// Bytes, fitted to the peaks of runs with two threads, so that nearly all took less; docs/OPTIONS.md has figures.
constexpr double perProcess = 60e6;      ///< the program and its libraries
constexpr double perOpenGl = 80e6;       ///< and the driver's
constexpr double perModelTriangle = 400; ///< of the mesh, the guard and the certifier
constexpr double perPlainTriangle = 250; ///< where there is no guard
constexpr double perQuad = 2200;         ///< of the surface, under the guard, with how it was decimated
constexpr double perLargeQuad = 800;     ///< where that is not recorded (largeSurface)
constexpr double perPlainQuad = 600;     ///< of the surface, where there is no guard
constexpr double perCageFace = 1500;     ///< of the cage, with what it is tightened by
constexpr double perVoxel = 0.2;         ///< of the bounding box
constexpr int countedResolution = 64; ///< what finer voxels show adds less than a third to the surface, mostly nothing

/// Passes questions on, but no stages: to count is none of a run's.
class QuestionsOnly : public Interrupter {
public:
    explicit QuestionsOnly(Interrupter* next) : next_(next) {}
    bool wasInterrupted(int /*percent*/) override { return next_ && next_->wasInterrupted(); }

private:
    Interrupter* next_;
};

/// What the memory of all resolutions follows from.
class Demand {
public:
    Demand(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
        : options_(options), modelTriangles_(static_cast<double>(model.triangles.size() + 2 * model.quads.size() +
                                                                 model.alternatives.size()))
    {
        QuestionsOnly questions(interrupter);
        CageOptions counted = options;
        counted.voxelizer = Voxelizer::cpu;
        if (options.interior == Interior::automatic) {
            counted.interior = rayAgreement(model, &questions) < mostlySheet ? Interior::shell : Interior::solid;
        }
        detail::Volumes volumes(model);
        const detail::ScaleVersion scale(options.scale);
        const auto quadsOf = [&](const detail::Voxels& voxels) {
            return surfaceOf(*volumes.closing(counted, scale, voxels, &questions), &questions)->quads.size();
        };
        const double longest = detail::longestSide(boundingBox(model));
        const openvdb::Vec3d extents = boundingBox(model).extents() / longest;
        const auto largest = [&] { return largestPart(model) / longest; };
        if (options.bounding) {
            share_ = detail::shareOfSide(options, {extents[0] * extents[1] * extents[2], largest, quadsOf});
        }
        detail::Voxels voxels = detail::finestVoxels(options, share_);
        voxels.resolution = std::min(voxels.resolution, static_cast<int>(countedResolution / share_));
        const double side = voxels.resolution;
        quads_ = static_cast<double>(quadsOf(voxels)) / (side * side);
        box_ = 1;
        for (const int axis : {0, 1, 2}) box_ *= extents[axis] + 1 / side;
    }

    /// Bytes, with another resolution or, if it is 0, with that of the options.
    double bytes(int resolution) const
    {
        CageOptions options = options_;
        if (resolution > 0) options.resolution = resolution;
        double together = 0, alone = 0; // bytes of surfaces: side by side, and of that which takes most by itself
        double finest = 0;              // resolution
        const auto add = [&](double quads, const CageOptions& competitor) {
            const double recorded = quads * (competitor.bounding ? perQuad : perPlainQuad);
            if (!competitor.bounding || quads <= detail::policy::largeSurface) {
                together += recorded;
            } else {
                alone = std::max(alone, competitor.mesh == CageFaces::loops ? recorded : quads * perLargeQuad);
            }
        };
        for (const CageOptions& competitor : detail::competitors(options)) {
            const bool areLoops = competitor.mesh == CageFaces::loops && !competitor.resolution;
            for (const std::vector<detail::Voxels>& rungs : detail::ladders(competitor, share_)) {
                const int wanted = rungs.front().resolution;
                const double first = areLoops ? detail::policy::quadsPerLoopsFace * competitor.faces
                                              : quads_ * static_cast<double>(wanted) * wanted;
                if (detail::mayBeTurned(competitor)) add(first, competitor);
                for (const double scale : detail::startScales(competitor)) {
                    add(first * scale * scale, competitor);
                    finest = std::max(finest, scale * wanted);
                }
            }
        }
        const double voxels = perVoxel * box_ * finest * finest * finest;
        return perProcess + (options.voxelizer == Voxelizer::gl ? perOpenGl : 0) +
               modelTriangles_ * (options.bounding ? perModelTriangle : perPlainTriangle) +
               perCageFace * options.faces + std::max({together, alone, voxels});
    }

    /// The finest resolution, below that of the options, with which it takes `limit` bytes at most; 0: there is none.
    int finestWithin(double limit) const
    {
        int fits = detail::finestVoxels(options_, share_).resolution - 1;
        while (fits >= least && bytes(fits) > limit) --fits; // larger surfaces may take less: they are not recorded
        return fits >= least ? fits : 0;
    }

private:
    static constexpr int least = 8; ///< resolution that can be asked for

    const CageOptions options_;
    const double modelTriangles_;
    double share_ = 1; ///< shareOfSide()
    double quads_ = 0; ///< of the closing's surface, for the square of the resolution
    double box_ = 0;   ///< its volume, for the cube of the longest side
};

Demand demandOf(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    if (options.leastPart <= 0) return {model, options, interrupter};
    return {largeParts(model, options.leastPart).mesh, options, interrupter};
}

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

MemoryError::~MemoryError() = default; // the key function, as those of core/error.cpp

std::size_t predictedMemory(const Mesh& model, const CageOptions& options, Interrupter* interrupter)
{
    requireValid(options);
    requireUsable(model, "model");
    return static_cast<std::size_t>(demandOf(model, options, interrupter).bytes(0));
}

void requireMemory(const Mesh& model, const CageOptions& options, std::size_t limit, Interrupter* interrupter)
{
    requireValid(options);
    requireUsable(model, "model");
    const Demand demand = demandOf(model, options, interrupter);
    const auto allowed = static_cast<double>(limit);
    if (demand.bytes(0) <= allowed) return;
    const int finest = demand.finestWithin(allowed);
    const std::string resolution = options.resolution ? std::to_string(*options.resolution) : "auto";
    throw MemoryError("--resolution: '" + resolution + "' would take about " + sizeText(demand.bytes(0)) +
                      " of memory, and " + sizeText(allowed) + " is allowed; " +
                      (finest > 0 ? "with " + std::to_string(finest) + " it would fit" : "no resolution would fit"));
}

} // namespace vdbcage
