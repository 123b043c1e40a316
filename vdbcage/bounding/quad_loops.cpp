#include <vdbcage/bounding/quad_loops.h>

#include <optional>
#include <string>
#include <vector>

#include <vdbcage/bounding/detail/face_queries.h>
#include <vdbcage/bounding/detail/loop_decimation.h>
#include <vdbcage/bounding/detail/merge_triangles.h>
#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/bounding/detail/tightening.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

using namespace detail;

namespace {

/// Makes quads of the pairs of triangles that are one in the table; returns those that it could not.
std::vector<std::uint32_t> pairAll(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter)
{
    std::vector<std::uint32_t> left;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q)) continue;
        throwIfInterrupted(interrupter);
        const Vec4I& ids = table.corners(q);
        const std::uint32_t f = faceAt(surface, ids[0], ids[1]), g = faceAt(surface, ids[2], ids[3]);
        if (surface.isInQuad(f)) continue;
        if (!mergeTriangles(surface, f, g)) left.push_back(q);
    }
    return left;
}

/// Makes all quads, with ever more room where it does not go.
void makeQuads(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter)
{
    constexpr int rounds = 8, sweeps = 3;
    constexpr ShapeWeight shape{2, 0.1};
    double room = medianDistance(surface);
    inflate(surface, room, interrupter);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<std::uint32_t> left = pairAll(surface, table, interrupter);
        if (left.empty()) return;
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t q : left) {
            for (int i = 0; i < 4; ++i) corners.push_back(table.corners(q)[i]);
        }
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        inflate(surface, corners, room, interrupter);
        relaxQuads(surface, table, shape, sweeps, interrupter);
        room *= 1.5;
    }
}

bool areSquare(const GuardedMesh& surface, const QuadTable& table, const QuadLoopsOptions& options)
{
    const CornerAngles angles = cornerAngles(surface, table);
    return angles.mean <= options.meanAngleDegrees && angles.mostOf95 <= options.mostAngleDegrees;
}

/// Tightens with the least weight of the shape that makes the corners as square as asked.
void tightenSquarely(GuardedMesh& surface, const QuadTable& table, const QuadLoopsOptions& options,
                     Interrupter* interrupter)
{
    constexpr double firstShare = 0.05, mostShare = 2, free = 0.15;
    const TightenOptions& tightening = options.tightening;
    for (double share = firstShare; share < mostShare; share *= 1.6) {
        const double sample = areaPerSample(surface, surface.liveFaces(), tightening.samples);
        const double perQuad = integratedDistance(surface, sample) / static_cast<double>(table.count());
        const CornerShape shape(table, share * perQuad, free);
        tighten(surface, tightening.sweeps, sample, interrupter, &shape);
        if (!areSquare(surface, table, options)) continue;
        perturb(surface, tightening.perturbations, tightening.sweeps, sample, interrupter, &shape);
        if (areSquare(surface, table, options)) return;
    }
}

} // namespace

Mesh quadLoops(const Mesh& surface, const BoundingGuard& guard, const QuadLoopsOptions& options,
               Interrupter* interrupter)
{
    if (options.faces < 6) {
        throw InputError("faces: " + std::to_string(options.faces) +
                         " is not allowed; a closed surface of quads has at least 6");
    }
    requireValid(options.tightening);
    GuardedMesh guarded(surface, modelOf(guard), GuardedMesh::Quads::split);
    QuadTable table(guarded);
    if (table.count() == 0) return guarded.mesh();
    shrink(guarded, interrupter);
    collapseLoops(guarded, table, options.faces / guarded.copies(), interrupter);
    makeQuads(guarded, table, interrupter);
    tightenSquarely(guarded, table, options, interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
