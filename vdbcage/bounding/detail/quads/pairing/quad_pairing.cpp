#include <vdbcage/bounding/detail/quads/pairing/quad_pairing.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/alternating_path.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>
#include <vdbcage/bounding/detail/quads/pairing/polychord.h>
#include <vdbcage/bounding/detail/quads/pairing/quad_candidates.h>
#include <vdbcage/bounding/detail/triangles/relax.h>

namespace vdbcage::detail {

namespace {

/// Returns the integral of the distance to the model over a mean face.
double distancePerFace(const GuardedMesh& surface, Interrupter* interrupter)
{
    constexpr int samplesPerFace = 4;
    const std::size_t faces = surface.liveFaces();
    return integratedDistance(surface, areaPerSample(surface, faces, samplesPerFace), interrupter) /
           static_cast<double>(faces);
}

bool hasEnoughQuads(const GuardedMesh& surface, const PairingOptions& options)
{
    return quadShare(surface) >= options.share;
}

/// Pairs candidates. One face less, if the others stay as many and as good, is worth the distance of a face: pairs that
/// cost more are made only to reach the share.
void pairGreedily(GuardedMesh& surface, const std::vector<QuadCandidate>& candidates, const PairingOptions& options,
                  Interrupter* interrupter)
{
    for (const bool costly : {false, true}) {
        for (const QuadCandidate& candidate : candidates) {
            throwIfInterrupted(interrupter);
            if (costly && hasEnoughQuads(surface, options)) return;
            if (costly != (candidate.loss > 1)) continue;
            if (surface.isInQuad(candidate.f) || surface.isInQuad(candidate.g)) continue;
            mergeTriangles(surface, candidate.f, candidate.g);
        }
    }
}

/// Pairs one triangle after the other, by as few pairs as will do.
void pairAlongPaths(GuardedMesh& surface, const PairingOptions& options, double maxGrowth, Interrupter* interrupter)
{
    for (const std::uint32_t f : trianglesOf(surface)) {
        for (std::size_t pairs = 1; pairs <= options.maxPathPairs && isTriangle(surface, f); ++pairs) {
            if (hasEnoughQuads(surface, options)) return;
            throwIfInterrupted(interrupter);
            pairAlongPath(surface, f, {options.mergeAngleDegrees, maxGrowth, pairs, PathEnd::quad});
        }
    }
}

double shortestEdgeSqr(const Corners& t)
{
    return std::min({(t[1] - t[0]).lengthSqr(), (t[2] - t[1]).lengthSqr(), (t[0] - t[2]).lengthSqr()});
}

/// Collapses triangles along paths, those nearest to each other first, and with the shortest edges.
void collapseAlongPaths(GuardedMesh& surface, const PairingOptions& options, double maxGrowth, Interrupter* interrupter)
{
    for (std::size_t pairs = 1; pairs <= options.maxPathPairs; ++pairs) {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const std::uint32_t f : trianglesOf(surface)) order.emplace_back(shortestEdgeSqr(surface.corners(f)), f);
        std::sort(order.begin(), order.end());
        for (const auto& next : order) {
            if (hasEnoughQuads(surface, options)) return;
            if (!isTriangle(surface, next.second)) continue;
            throwIfInterrupted(interrupter);
            pairAlongPath(surface, next.second, {options.mergeAngleDegrees, maxGrowth, pairs, PathEnd::collapse});
        }
    }
}

/// Splits polychords, the shortest first: each adds a face for every quad in it.
void splitPolychords(GuardedMesh& surface, const PairingOptions& options, double maxGrowth, Interrupter* interrupter)
{
    for (std::size_t length = 1; length <= 2 * options.maxPathPairs; ++length) {
        for (const std::uint32_t f : trianglesOf(surface)) {
            for (int i = 0; i < 3 && isTriangle(surface, f); ++i) {
                throwIfInterrupted(interrupter);
                if (hasEnoughQuads(surface, options)) return;
                const std::optional<Polychord> polychord = polychordFrom(surface, f, i, length);
                if (polychord && polychord->quads.size() == length) splitPolychord(surface, *polychord, maxGrowth);
            }
        }
    }
}

} // namespace

double quadShare(const GuardedMesh& surface)
{
    const auto faces = static_cast<double>(surface.liveFaces() - surface.quads());
    return faces > 0 ? static_cast<double>(surface.quads()) / faces : 1;
}

void pairUp(GuardedMesh& surface, const PairingOptions& options, Interrupter* interrupter)
{
    if (surface.liveFaces() == 0) return;
    surface.limitQuadFold(options.mergeAngleDegrees);
    const double perFace = distancePerFace(surface, interrupter);
    const double maxGrowth = options.maxLoss * perFace;
    pairGreedily(surface, quadCandidates(surface, options.mergeAngleDegrees, perFace), options, interrupter);
    pairAlongPaths(surface, options, maxGrowth, interrupter);
    if (options.collapses) collapseAlongPaths(surface, options, maxGrowth, interrupter);
    if (options.splits) splitPolychords(surface, options, maxGrowth, interrupter);
}

} // namespace vdbcage::detail
