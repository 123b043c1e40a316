// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, "Mesh Optimization", 1993 (edges split, collapsed and
// swapped, each with its vertices placed again, kept where the distance to the data drops).
// Differs: greedy in rounds of many under the guard, not one random move at a time.

#include <vdbcage/bounding/detail/triangles/redistribute.h>

#include <vdbcage/bounding/detail/guard/admissible.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/bounding/detail/triangles/collapse.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

constexpr int samplesPerFace = 4;

/// The split of the edge from a to b, or its flip to `centre`.
struct EdgeChange {
    std::uint32_t a, b, centre = StarChange::none;
    double gain = 0; ///< of distance; of a split for two more faces
    Vec3d place{0.0};
};

/// Makes the star of a change. Returns false where there is none.
bool starOf(const GuardedMesh& surface, const EdgeChange& change, StarChange& star)
{
    if (change.centre != StarChange::none) return starOfFlip(surface, change.centre, change.a, change.b, star);
    star = starOfSplit(surface, change.a, change.b);
    return !star.oldFaces.empty();
}

/// Finds a change's best place and its gain there, 0 or less where it brings the surface no nearer to the model.
void findPlace(const GuardedMesh& surface, const DistanceMeasure& measure, EdgeChange& change)
{
    StarChange star;
    if (!starOf(surface, change, star)) return;
    const Vec3d along = surface.point(change.b) - surface.point(change.a);
    const Vec3d up = outward(surface, star) * along.length();
    const bool isSplit = change.centre == StarChange::none;
    const Vec3d start = isSplit ? surface.point(change.a) + 0.5 * along : surface.point(change.centre);
    double before = 0;
    std::uint32_t seed = TriangleBvh::none;
    for (const std::uint32_t f : star.oldFaces) before += measure.integral(surface.corners(f), seed);
    // At the place, or a little off: the middle of an edge is rounded, and a flip of a ridge needs room.
    constexpr std::array<double, 4> offEdge{0.0, 1e-5, 1e-3, 0.03}, offVertex{0.0, 1e-3, 0.03, 0.1};
    for (const double off : isSplit ? offEdge : offVertex) {
        change.place = rounded(surface, star, start + off * up);
        if (!allows(surface, star, change.place)) continue;
        DistanceMeasure::Fit fit = measure.fit(surface, star, change.place, seed);
        measure.improve(surface, star, change.place, fit, seed, {});
        const auto added = static_cast<double>(star.link.size() - star.oldFaces.size());
        change.gain = (added > 0 ? 2 / added : 1) * (before - fit.integral);
        return;
    }
}

/// Makes the changes that gain, those that gain most first, until there are `faces`; no two touch the same face.
void makeBest(GuardedMesh& surface, std::vector<EdgeChange> changes, std::size_t faces, double areaPerSample,
              Interrupter* interrupter)
{
    const DistanceMeasure measure(surface, areaPerSample);
    parallelFor(std::size_t(0), changes.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter);
        findPlace(surface, measure, changes[i]);
    });
    const auto gainsNothing = [](const EdgeChange& change) { return !(change.gain > 0); };
    changes.erase(std::remove_if(changes.begin(), changes.end(), gainsNothing), changes.end());
    std::stable_sort(changes.begin(), changes.end(),
                     [](const EdgeChange& a, const EdgeChange& b) { return a.gain > b.gain; });
    std::vector<char> changed(surface.faces() + 2 * changes.size(), 0);
    StarChange star;
    for (const EdgeChange& change : changes) {
        throwIfInterrupted(interrupter);
        if (surface.liveFaces() >= faces) return;
        if (!starOf(surface, change, star)) continue;
        const auto wasChanged = [&](std::uint32_t f) { return changed[f] != 0; };
        if (std::any_of(star.oldFaces.begin(), star.oldFaces.end(), wasChanged)) continue;
        if (!allows(surface, star, change.place)) continue;
        surface.apply(star, change.place);
        for (const std::uint32_t f : surface.facesOf(star.centre)) changed[f] = 1;
    }
}

/// Splits edges until there are `faces`, or none gains.
void splitBest(GuardedMesh& surface, std::size_t faces, double areaPerSample, Interrupter* interrupter)
{
    std::vector<EdgeChange> splits;
    for (std::uint32_t a = 0; a < surface.vertices(); ++a) {
        for (const std::uint32_t b : surface.neighbours(a)) {
            if (a < b) splits.push_back({a, b});
        }
    }
    makeBest(surface, std::move(splits), faces, areaPerSample, interrupter);
}

} // namespace

void redistribute(GuardedMesh& surface, int rounds, int sweeps, Interrupter* interrupter)
{
    const std::size_t faces = surface.liveFaces();
    if (faces == 0) return;
    const double perSample = areaPerSample(surface, faces, samplesPerFace);
    double share = 1; // of the faces that are added, if possible, and removed again
    double distance = integratedDistance(surface, perSample, interrupter);
    for (int i = 0; i < rounds; ++i) {
        const auto say = [&](int percent) { throwIfInterrupted(interrupter, (100 * i + percent) / rounds); };
        say(0);
        GuardedMesh changed = surface;
        const auto added = static_cast<std::size_t>(share * static_cast<double>(faces));
        splitBest(changed, faces + added, perSample, interrupter);
        say(25);
        tighten(changed, sweeps, perSample, interrupter);
        say(50);
        collapseByQuadrics(changed, faces, interrupter);
        say(75);
        tighten(changed, sweeps, perSample, interrupter);
        const double after = integratedDistance(changed, perSample, interrupter);
        if (changed.liveFaces() <= faces && after < distance) {
            distance = after;
            surface = std::move(changed);
        } else {
            share *= 0.5;
        }
    }
}

void flipEdges(GuardedMesh& surface, int sweeps, Interrupter* interrupter)
{
    if (surface.liveFaces() == 0) return;
    const double perSample = areaPerSample(surface, surface.liveFaces(), samplesPerFace);
    constexpr auto anyNumber = std::numeric_limits<std::size_t>::max();
    std::vector<EdgeChange> flips;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        for (const auto& edge : starOf(surface, v).link) flips.push_back({edge[0], edge[1], v});
    }
    makeBest(surface, std::move(flips), anyNumber, perSample, interrupter);
    tighten(surface, sweeps, perSample, interrupter);
}

} // namespace vdbcage::detail
