// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, "Mesh Optimization", 1993 (splits and collapses, each with its
// vertices placed anew, kept where the distance to the data drops).
// Differs: greedy in rounds of many splits and collapses under the guard, not one random move at a time.

#include <vdbcage/surface/detail/guarded_exchange.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <tbb/parallel_for.h>
#include <vdbcage/surface/detail/fan_fit.h>
#include <vdbcage/surface/detail/guarded_decimate.h>
#include <vdbcage/surface/detail/guarded_sweeps.h>

namespace vdbcage::detail {

namespace {

struct Split {
    double gain; ///< for two more faces
    std::uint32_t u, v;
    Vec3d place;
};

/// The best split of an edge, if one brings the surface nearer to the model.
std::optional<Split> trySplit(const GuardedSurface& surface, const DistanceMeasure& measure, std::uint32_t u,
                              std::uint32_t v)
{
    const Fan fan = surface.fanOfSplit(u, v);
    const Vec3d along = surface.point(v) - surface.point(u);
    const Vec3d up = surface.outward(fan) * along.length();
    double before = 0;
    std::uint32_t seed = TriangleTree::none;
    for (const std::uint32_t f : fan.oldFaces) before += measure.integral(surface.corners(f), seed);
    // On the edge, or a little off, since its middle is rounded.
    for (const double off : {0.0, 1e-5, 1e-3, 0.03}) {
        Vec3d place = surface.rounded(fan, surface.point(u) + 0.5 * along + off * up);
        if (!surface.allows(fan, place)) continue;
        DistanceMeasure::Fit fit = measure.fit(surface, fan, place, seed);
        measure.improve(surface, fan, place, fit, seed);
        if (!(fit.integral < before)) return std::nullopt;
        const auto added = static_cast<double>(fan.rim.size() - fan.oldFaces.size());
        return Split{2 / added * (before - fit.integral), u, v, place};
    }
    return std::nullopt;
}

/// Splits edges, those that gain most first, until there are `faces`; no two splits of one round touch the same face.
void splitBest(GuardedSurface& surface, std::size_t faces, double areaPerSample)
{
    const DistanceMeasure measure(surface.guard(), areaPerSample);
    std::vector<std::vector<Split>> found(surface.vertices());
    tbb::parallel_for(std::uint32_t(0), surface.vertices(), [&](std::uint32_t u) {
        for (const std::uint32_t v : surface.neighbours(u)) {
            if (v < u) continue;
            if (const auto split = trySplit(surface, measure, u, v)) found[u].push_back(*split);
        }
    });
    std::vector<Split> splits;
    for (const auto& list : found) splits.insert(splits.end(), list.begin(), list.end());
    std::stable_sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) { return a.gain > b.gain; });
    std::vector<char> changed(surface.faces() + 2 * splits.size(), 0);
    for (const Split& split : splits) {
        if (surface.liveFaces() >= faces) return;
        const Fan fan = surface.fanOfSplit(split.u, split.v);
        const auto wasChanged = [&](std::uint32_t f) { return changed[f] != 0; };
        if (fan.oldFaces.empty() || std::any_of(fan.oldFaces.begin(), fan.oldFaces.end(), wasChanged)) continue;
        if (!surface.allows(fan, split.place)) continue;
        surface.apply(fan, split.place);
        for (const std::uint32_t f : surface.facesOf(fan.centre)) changed[f] = 1;
    }
}

} // namespace

void exchange(GuardedSurface& surface, int rounds, int sweeps, Interrupter* interrupter)
{
    constexpr int samplesPerFace = 4;
    const std::size_t faces = surface.liveFaces();
    if (faces == 0) return;
    const double perSample = areaPerSample(surface, faces, samplesPerFace);
    double share = 1; // of the faces that are added, as far as that goes, and taken away again
    double distance = integratedDistance(surface, perSample);
    for (int i = 0; i < rounds; ++i) {
        GuardedSurface changed = surface;
        const auto added = static_cast<std::size_t>(share * static_cast<double>(faces));
        splitBest(changed, faces + added, perSample);
        tighten(changed, sweeps, perSample, interrupter);
        collapseByQuadrics(changed, faces, interrupter);
        tighten(changed, sweeps, perSample, interrupter);
        const double after = integratedDistance(changed, perSample);
        if (changed.liveFaces() <= faces && after < distance) {
            distance = after;
            surface = std::move(changed);
        } else {
            share *= 0.5;
        }
    }
}

} // namespace vdbcage::detail
