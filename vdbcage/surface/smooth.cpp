// Based on: Vollmer, Mencl, Muller, Improved Laplacian Smoothing of Noisy Surface Meshes, Eurographics 1999.
// Differs: quads are smoothed as quads (their edges, not their diagonals, make neighbours); every vertex moves at once.
#include <vdbcage/surface/smooth.h>

#include <algorithm>
#include <numeric>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage {

namespace {

using openvdb::Index32;
using openvdb::Vec3d;

template <typename Body>
void forEachPoint(std::size_t count, Interrupter* interrupter, int percent, const Body& body)
{
    detail::parallelFor(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        throwIfInterrupted(interrupter, percent);
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
}

/// The points that share an edge with each point, ascending: those of point i are [first[i], last[i]) in `points`.
struct Neighbours {
    std::vector<std::size_t> first, last;
    std::vector<Index32> points;

    std::size_t count(std::size_t i) const { return last[i] - first[i]; }
    Vec3d mean(std::size_t i, const std::vector<Vec3d>& values) const
    {
        Vec3d sum(0.0);
        for (std::size_t n = first[i]; n < last[i]; ++n) sum += values[points[n]];
        return sum / double(count(i));
    }
};

template <typename Visit>
void forEachEdge(const Mesh& mesh, const Visit& visit)
{
    for (const openvdb::Vec3I& face : mesh.triangles) {
        for (int i = 0; i < 3; ++i) visit(face[i], face[(i + 1) % 3]);
    }
    for (const openvdb::Vec4I& face : mesh.quads) {
        for (int i = 0; i < 4; ++i) visit(face[i], face[(i + 1) % 4]);
    }
}

Neighbours findNeighbours(const Mesh& mesh, Interrupter* interrupter)
{
    Neighbours result;
    result.first.assign(mesh.points.size() + 1, 0);
    forEachEdge(mesh, [&](Index32 a, Index32 b) {
        ++result.first[a + 1];
        ++result.first[b + 1];
    });
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.last.assign(result.first.begin(), result.first.end() - 1);
    result.points.resize(result.first.back());
    forEachEdge(mesh, [&](Index32 a, Index32 b) {
        result.points[result.last[a]++] = b;
        result.points[result.last[b]++] = a;
    });
    // Most edges came twice, once from each face.
    forEachPoint(mesh.points.size(), interrupter, 0, [&](std::size_t i) {
        const auto begin = result.points.begin() + std::ptrdiff_t(result.first[i]);
        const auto end = result.points.begin() + std::ptrdiff_t(result.last[i]);
        std::sort(begin, end);
        const auto unique = std::remove(begin, std::unique(begin, end), Index32(i));
        result.last[i] = std::size_t(unique - result.points.begin());
    });
    return result;
}

} // namespace

Mesh smooth(const Mesh& surface, const SmoothOptions& options, Interrupter* interrupter)
{
    requireWithin(SmoothOptions::iterationCounts, options.iterations, "iterations");
    requireWithin(SmoothOptions::alphas, options.alpha, "alpha");
    requireWithin(SmoothOptions::betas, options.beta, "beta");
    requireUsable(surface, "the surface to smooth");

    Mesh result = surface;
    if (options.iterations == 0) return result;
    const Neighbours neighbours = findNeighbours(surface, interrupter);
    const std::size_t count = surface.points.size();
    const std::vector<Vec3d>& original = surface.points;
    std::vector<Vec3d>& points = result.points;
    std::vector<Vec3d> moved(count), corrections(count, Vec3d(0.0));
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
        const int percent = 100 * iteration / options.iterations;
        // The Laplacian step, and its distance for each vertex from its place before and from its start.
        forEachPoint(count, interrupter, percent, [&](std::size_t i) {
            if (neighbours.count(i) == 0) return;
            moved[i] = neighbours.mean(i, points);
            corrections[i] = moved[i] - (options.alpha * original[i] + (1 - options.alpha) * points[i]);
        });
        // The step back, evened out over the neighbours.
        forEachPoint(count, interrupter, percent, [&](std::size_t i) {
            if (neighbours.count(i) == 0) return;
            points[i] =
                moved[i] - (options.beta * corrections[i] + (1 - options.beta) * neighbours.mean(i, corrections));
        });
    }
    return result;
}

} // namespace vdbcage
