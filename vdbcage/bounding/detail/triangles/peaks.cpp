#include <vdbcage/bounding/detail/triangles/peaks.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/star_change.h>
#include <vdbcage/bounding/detail/triangles/relax.h>

namespace vdbcage::detail {

namespace {

constexpr double aboveMean = 12; // distances from the model, over the mean of the cage
constexpr int samples = 4;       // of the distance, for a face of mean size

double distanceAt(const GuardedMesh& surface, const Vec3d& p)
{
    return std::sqrt(surface.guard().tree().closest(p).squaredDistance);
}

/// Returns the greatest distance from the model of the star with its centre at `p`: of its corners, edges and middles.
double greatestDistance(const GuardedMesh& surface, const StarChange& star, const Vec3d& p)
{
    double most = distanceAt(surface, p);
    for (const auto& edge : star.link) {
        const Vec3d &a = surface.point(edge[0]), &b = surface.point(edge[1]);
        for (const Vec3d& at : {a, (p + a) / 2, (a + b) / 2, (p + a + b) / 3}) {
            most = std::max(most, distanceAt(surface, at));
        }
    }
    return most;
}

/// Returns the vertices that stick out, the farthest first.
std::vector<std::uint32_t> peaksOf(const GuardedMesh& surface, double mean)
{
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (!surface.isVertex(v)) continue;
        const double distance = distanceAt(surface, surface.point(v));
        if (distance <= aboveMean * mean) continue;
        const auto neighbours = surface.neighbours(v);
        const bool isPeak = std::all_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t w) {
            return distance >= distanceAt(surface, surface.point(w));
        });
        if (isPeak) found.emplace_back(-distance, v);
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> peaks;
    for (const auto& peak : found) peaks.push_back(peak.second);
    return peaks;
}

/// Returns places for a vertex on the way to the model, the nearest to it first.
std::vector<Vec3d> placesBelow(const GuardedMesh& surface, const Vec3d& p)
{
    const Vec3d onModel = surface.guard().tree().closest(p).point;
    Vec3d away = p - onModel;
    away.normalize();
    const Vec3d goal = onModel + 1.01 * surface.guard().clearance() * away;
    std::vector<Vec3d> places;
    for (const double left : {0.0, 0.02, 0.1, 0.3}) places.push_back(goal + left * (p - goal));
    return places;
}

/// Reduces a peak by a change around its vertex. The vertex is removed, or an edge near it is collapsed or flipped,
/// which lets it sink. Returns false where nothing halves its distance.
bool flatten(GuardedMesh& surface, std::uint32_t peak)
{
    const Vec3d at = surface.point(peak);
    double least = distanceAt(surface, at) / 2;
    StarChange best;
    Vec3d bestPlace;
    const auto offer = [&](const StarChange& star, const Vec3d& p) {
        const Vec3d place = rounded(surface, star, p);
        const double distance = greatestDistance(surface, star, place);
        if (distance >= least || !allows(surface, star, place)) return;
        least = distance;
        best = star;
        bestPlace = place;
    };
    const std::vector<Vec3d> below = placesBelow(surface, at);
    StarChange star;
    for (const std::uint32_t w : surface.neighbours(peak)) {
        if (starOfCollapse(surface, w, peak, star)) offer(star, surface.point(w));
        if (!starOfCollapse(surface, peak, w, star)) continue;
        for (const Vec3d& place : below) offer(star, place);
    }
    const StarChange now = starOf(surface, peak);
    for (const auto& edge : now.link) {
        if (!starOfFlip(surface, peak, edge[0], edge[1], star)) continue;
        for (const Vec3d& place : below) offer(star, place);
    }
    if (best.centre == StarChange::none) return false;
    surface.apply(best, bestPlace);
    return true;
}

} // namespace

Mesh withoutPeaks(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter)
{
    GuardedMesh surface(cage, modelOf(guard), GuardedMesh::Quads::split, wishes);
    if (surface.liveFaces() == 0) return cage;
    const double perSample = areaPerSample(surface, surface.liveFaces(), samples);
    const double mean = integratedDistance(surface, perSample, interrupter) / area(surface);
    bool isChanged = false;
    for (bool isFlattened = true; isFlattened;) { // each halves a distance
        isFlattened = false;
        for (const std::uint32_t peak : peaksOf(surface, mean)) {
            throwIfInterrupted(interrupter);
            if (surface.isVertex(peak)) isFlattened = flatten(surface, peak) || isFlattened;
        }
        isChanged = isChanged || isFlattened;
    }
    return isChanged ? surface.mesh() : cage;
}

} // namespace vdbcage::detail
