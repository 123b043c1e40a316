// Based on: Vollmer, Mencl, Muller, "Improved Laplacian Smoothing of Noisy Surface Meshes", 1999 (roundOff).
// Differs: moves that the guard does not allow are shortened or left out.

#include <vdbcage/bounding/detail/triangles/relax.h>

#include <vdbcage/bounding/detail/triangles/sweep.h>

#include <vdbcage/bounding/detail/guard/admissible.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

/// Returns the mean of a value, added to a zero `sum`, over the vertices around the star's centre. On the plane of
/// symmetry it is over both halves, as far as the mirror image does not reverse it.
template <typename Sum, typename Value>
Sum ringMean(const StarChange& star, Sum sum, const Value& value)
{
    for (const auto& edge : star.link) {
        sum += value(edge[0]);
        if (star.onPlane) sum += value(edge[1]); // twice within the link, once at its ends
    }
    return sum / static_cast<double>((star.onPlane ? 2 : 1) * star.link.size());
}

Vec3d ringAverage(const GuardedMesh& surface, const StarChange& star)
{
    const Vec3d average = ringMean(star, Vec3d(0.0), [&](std::uint32_t v) { return surface.point(v); });
    return star.onPlane ? surface.ontoPlane(average) : average;
}

double meanIncidentEdge(const GuardedMesh& surface, const StarChange& star)
{
    return ringMean(star, 0.0,
                    [&](std::uint32_t v) { return (surface.point(v) - surface.point(star.centre)).length(); });
}

} // namespace

void inflate(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, double by, Interrupter* interrupter,
             const ShapeTerm* shape)
{
    sweep(surface, vertices, interrupter, [&](std::uint32_t v, const StarChange& star) {
        return towards(surface, star, surface.point(v) + by * outward(surface, star), {1.0, 0.5, 0.2}, shape);
    });
}

namespace {

/// Returns the integral of the distance to the model over each face and each alternate, by number.
std::vector<double> distances(const GuardedMesh& surface, double areaPerSample, Interrupter* interrupter)
{
    const DistanceMeasure measure(surface, areaPerSample);
    std::vector<double> integrals(surface.faces(), 0);
    parallelFor(std::uint32_t(0), surface.vertices(), [&](std::uint32_t v) {
        throwIfInterrupted(interrupter);
        std::uint32_t seed = TriangleBvh::none;
        for (const auto* list : {&surface.facesOf(v), &surface.alternatesOf(v)}) {
            for (const std::uint32_t f : *list) {
                if (surface.face(f)[0] != v) continue; // each once
                integrals[f] = surface.weight(f) * measure.integral(surface.corners(f), seed);
            }
        }
    });
    return integrals;
}

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Returns for each vertex the sum of a value over the faces around it, weighted most near it.
std::vector<double> gathered(const GuardedMesh& surface, const std::vector<double>& ofFaces)
{
    constexpr int rings = 2; // beyond the vertex's own
    const std::vector<std::uint32_t> vertices = allVertices(surface);
    std::vector<double> around(surface.vertices(), 0);
    for (const std::uint32_t v : vertices) {
        for (const auto* list : {&surface.facesOf(v), &surface.alternatesOf(v)}) {
            for (const std::uint32_t f : *list) around[v] += ofFaces[f];
        }
    }
    for (int i = 0; i < rings; ++i) {
        std::vector<double> wider = around;
        for (const std::uint32_t v : vertices) {
            for (const std::uint32_t w : surface.neighbours(v)) wider[v] += around[w];
        }
        around = std::move(wider);
    }
    return around;
}

/// Moves the vertices around which `growth`, by face, is above 0 back to their places in `before`, where allowed.
void undoWhereGrown(GuardedMesh& surface, const GuardedMesh& before, const std::vector<double>& growth,
                    Interrupter* interrupter)
{
    constexpr int passes = 3; // a vertex that neighbours block may move when these are back
    const std::vector<double> around = gathered(surface, growth);
    std::vector<std::uint32_t> vertices = allVertices(surface);
    const auto isBetter = [&](std::uint32_t v) { return !(around[v] > 0); };
    vertices.erase(std::remove_if(vertices.begin(), vertices.end(), isBetter), vertices.end());
    for (int i = 0; i < passes; ++i) {
        sweep(surface, vertices, interrupter, [&](std::uint32_t v, const StarChange& star) -> std::optional<Vec3d> {
            const Vec3d& place = before.point(v);
            if (surface.point(v) == place || !allows(surface, star, place)) return std::nullopt;
            return place;
        });
    }
}

} // namespace

double area(const GuardedMesh& surface)
{
    double sum = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            if (surface.face(f)[0] != v) continue; // each face once
            sum += 0.5 * areaNormal(surface, f).length();
        }
    }
    return sum;
}

double areaPerSample(const GuardedMesh& surface, std::size_t faces, int samples)
{
    return area(surface) / (static_cast<double>(samples) * static_cast<double>(faces));
}

void shrink(GuardedMesh& surface, Interrupter* interrupter)
{
    sweep(surface, allVertices(surface), interrupter, [&](std::uint32_t v, const StarChange& star) {
        const Vec3d closest = surface.guard().tree().closest(surface.point(v)).point;
        return towards(surface, star, 0.5 * (ringAverage(surface, star) + closest), {0.9, 0.5, 0.2});
    });
}

void inflate(GuardedMesh& surface, double by, Interrupter* interrupter)
{
    inflate(surface, allVertices(surface), by, interrupter);
}

void inflateTriangles(GuardedMesh& surface, double by, Interrupter* interrupter)
{
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t v : allVertices(surface)) {
        const auto& faces = surface.facesOf(v);
        if (std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return isTriangle(surface, f); }))
            vertices.push_back(v);
    }
    inflate(surface, vertices, by, interrupter);
}

void roundOff(GuardedMesh& surface, int sweeps, Interrupter* interrupter)
{
    constexpr double outwardShare = 0.02; // of the edges' length: a tight surface has no room to move
    const std::vector<std::uint32_t> vertices = allVertices(surface);
    std::vector<Vec3d> toAverage(surface.vertices(), Vec3d(0.0));
    for (int i = 0; i < sweeps; ++i) {
        parallelFor(std::size_t(0), vertices.size(), [&](std::size_t k) {
            const std::uint32_t v = vertices[k];
            toAverage[v] = ringAverage(surface, starOf(surface, v)) - surface.point(v);
        });
        sweep(surface, vertices, interrupter, [&](std::uint32_t v, const StarChange& star) {
            const Vec3d around = ringMean(star, Vec3d(0.0), [&](std::uint32_t w) { return toAverage[w]; });
            const Vec3d room = outwardShare * meanIncidentEdge(surface, star) * outward(surface, star);
            return towards(surface, star, surface.point(v) + 0.7 * toAverage[v] - 0.7 * around + room, {1.0, 0.5, 0.2});
        });
    }
}

double medianDistance(const GuardedMesh& surface)
{
    std::vector<double> distances;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            if (surface.face(f)[0] != v) continue; // each face once
            const Corners t = surface.corners(f);
            distances.push_back(std::sqrt(surface.guard().tree().closest((t[0] + t[1] + t[2]) / 3.0).squaredDistance));
        }
    }
    if (distances.empty()) return 0;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

double integratedDistance(const GuardedMesh& surface, double areaPerSample, Interrupter* interrupter)
{
    return sum(distances(surface, areaPerSample, interrupter));
}

void tighten(GuardedMesh& surface, int sweeps, double areaPerSample, Interrupter* interrupter, const ShapeTerm* shape)
{
    tighten(surface, allVertices(surface), sweeps, areaPerSample, interrupter, shape);
}

void tighten(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, int sweeps, double areaPerSample,
             Interrupter* interrupter, const ShapeTerm* shape)
{
    constexpr double sleepBelow = 0.002; // a smaller part gained: not tried again until a neighbour moves
    constexpr double stopBelow = 0.002;  // the same for a whole sweep
    constexpr int gentleSweeps = 6;
    const DistanceMeasure measure(surface, areaPerSample, shape);
    const std::size_t n = surface.vertices();
    std::vector<std::uint32_t> seed(n, TriangleBvh::none);
    std::vector<double> before(n, 0), after(n, 0);
    std::vector<std::uint32_t> active = vertices;
    for (int i = 0; i < sweeps && !active.empty(); ++i) {
        DistanceMeasure::Pace pace;
        pace.share = i < gentleSweeps ? 0.5 : 1;
        std::vector<char> becomesActive(n, 0);
        double gain = 0, total = 0;
        sweep(
            surface, active, interrupter,
            [&](std::uint32_t v, const StarChange& star) -> std::optional<Vec3d> {
                Vec3d p = surface.point(v);
                DistanceMeasure::Fit fit = measure.fit(surface, star, p, seed[v]);
                before[v] = after[v] = fit.integral;
                if (!measure.improve(surface, star, p, fit, seed[v], pace)) return std::nullopt;
                after[v] = fit.integral;
                return p;
            },
            [&](std::uint32_t v, const StarChange& star, bool moved) {
                total += before[v];
                if (!moved) return;
                gain += before[v] - after[v];
                if (before[v] - after[v] < sleepBelow * before[v]) return;
                becomesActive[v] = 1;
                for (const auto& edge : star.link) becomesActive[edge[0]] = becomesActive[edge[1]] = 1;
            });
        if (!(gain > stopBelow * total)) break;
        active.clear();
        std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(active),
                     [&](std::uint32_t v) { return becomesActive[v] != 0; });
    }
}

void relaxFinally(GuardedMesh& surface, double areaPerSample, Interrupter* interrupter, const ShapeTerm* shape)
{
    constexpr int sweeps = 2;
    DistanceMeasure::Pace pace;
    pace.least = 1e-5;
    pace.gain = 1e-4;
    const DistanceMeasure measure(surface, areaPerSample, shape);
    std::vector<std::uint32_t> seed(surface.vertices(), TriangleBvh::none);
    for (int i = 0; i < sweeps; ++i) {
        sweep(surface, allVertices(surface), interrupter,
              [&](std::uint32_t v, const StarChange& star) -> std::optional<Vec3d> {
                  Vec3d p = surface.point(v);
                  DistanceMeasure::Fit fit = measure.fit(surface, star, p, seed[v]);
                  if (!measure.improve(surface, star, p, fit, seed[v], pace)) return std::nullopt;
                  return p;
              });
    }
}

void perturb(GuardedMesh& surface, int times, int sweeps, double areaPerSample, Interrupter* interrupter,
             const ShapeTerm* shape)
{
    if (surface.liveFaces() == 0) return;
    std::vector<double> now = distances(surface, areaPerSample, interrupter);
    double push = 0.3; // of the mean distance
    for (int i = 0; i < times; ++i) {
        const auto say = [&](int percent) { throwIfInterrupted(interrupter, (100 * i + percent) / times); };
        say(0);
        GuardedMesh perturbed = surface;
        inflate(perturbed, push * sum(now) / area(surface), interrupter);
        tighten(perturbed, sweeps, areaPerSample, interrupter, shape);
        std::vector<double> growth = distances(perturbed, areaPerSample, interrupter);
        std::transform(growth.begin(), growth.end(), now.begin(), growth.begin(), std::minus<>());
        undoWhereGrown(perturbed, surface, growth, interrupter);
        say(50);
        tighten(perturbed, sweeps, areaPerSample, interrupter, shape);
        std::vector<double> after = distances(perturbed, areaPerSample, interrupter);
        if (sum(after) < sum(now)) {
            now = std::move(after);
            surface = std::move(perturbed);
        } else {
            push *= 0.5;
        }
    }
}

} // namespace vdbcage::detail
