#include <vdbcage/bounding/detail/quads/quad_making.h>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>

namespace vdbcage::detail {

namespace {

std::vector<std::uint32_t> allQuads(const QuadTable& table)
{
    std::vector<std::uint32_t> quads;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (table.isQuad(q)) quads.push_back(q);
    }
    return quads;
}

/// Makes quads of the pairs of triangles that are one in the table, `first` before others. Returns those that it cannot
/// make.
std::vector<std::uint32_t> pairAll(GuardedMesh& surface, const QuadTable& table,
                                   const std::vector<std::uint32_t>& first, Interrupter* interrupter)
{
    std::vector<std::uint32_t> left;
    const std::vector<std::uint32_t> all = allQuads(table);
    for (const auto* list : {&first, &all}) {
        for (const std::uint32_t q : *list) {
            throwIfInterrupted(interrupter);
            const Vec4I& ids = table.corners(q);
            const std::uint32_t f = faceAt(surface, ids[0], ids[1]), g = faceAt(surface, ids[2], ids[3]);
            if (surface.isInQuad(f) || mergeTriangles(surface, f, g)) continue;
            if (list == &all) left.push_back(q);
        }
    }
    return left;
}

/// Splits the quads around some vertices, so that these can move more freely.
void splitAround(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices)
{
    for (const std::uint32_t v : vertices) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            if (surface.isInQuad(f)) surface.splitQuad(f);
        }
    }
}

/// Makes all quads. Those that fail get room of `room`, more in each round, and flatten(corners) makes them flatter.
/// Returns those that still fail.
template <typename Flatten>
std::vector<std::uint32_t> pairInRounds(GuardedMesh& surface, const QuadTable& table, double room,
                                        Interrupter* interrupter, const Flatten& flatten)
{
    constexpr int rounds = 10, vainRounds = 5;
    const QuadShapeTerm fit(table, {});
    std::vector<std::uint32_t> left = pairAll(surface, table, {}, interrupter);
    for (int round = 0, vain = 0; round < rounds && vain < vainRounds && !left.empty(); ++round) {
        const std::vector<std::uint32_t> corners = cornersOf(table, left);
        splitAround(surface, corners);
        inflate(surface, corners, room, interrupter, &fit);
        flatten(corners);
        inflate(surface, corners, room, interrupter, &fit);
        const std::size_t before = left.size();
        left = pairAll(surface, table, left, interrupter);
        vain = left.size() < before ? 0 : vain + 1;
        room *= 1.5;
    }
    return left;
}

constexpr int sweeps = 2;
constexpr ShapeWeights flat{2, 0.1, 0, 8, 8};

} // namespace

std::vector<std::uint32_t> makeQuads(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter)
{
    const double room = medianDistance(surface);
    const QuadShapeTerm fit(table, {});
    inflate(surface, cornersOf(table, allQuads(table)), room, interrupter, &fit);
    return pairInRounds(surface, table, room, interrupter, [&](const std::vector<std::uint32_t>& /*corners*/) {
        relaxQuads(surface, table, flat, sweeps, interrupter);
    });
}

std::vector<std::uint32_t> makeQuadsInPlace(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter)
{
    constexpr double share = 0.5; // of the median distance
    const double sample = areaPerSample(surface);
    const QuadShapeTerm term = shapeTerm(surface, table, flat, sample, interrupter);
    return pairInRounds(surface, table, share * medianDistance(surface), interrupter,
                        [&](const std::vector<std::uint32_t>& corners) {
                            tighten(surface, corners, sweeps, sample, interrupter, &term);
                        });
}

} // namespace vdbcage::detail
