#include <vdbcage/bounding/detail/loops/loop_split.h>

#include <array>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>

namespace vdbcage::detail {

namespace {

constexpr std::array heights{0.0, 0.01, 0.05, 0.15}; // for places that rounding brought too near

/// Joins the new vertices of two rungs across the former diagonal of their quad, from corner to corner.
bool join(GuardedMesh& surface, std::uint32_t v, std::uint32_t from, std::uint32_t to)
{
    StarChange star;
    if (!starOfFlip(surface, v, from, to, star)) return false;
    const Vec3d place = surface.point(v);
    return applyNear(surface, star, place, (surface.point(from) - place).length(), heights);
}

} // namespace

std::vector<std::uint32_t> splitLoop(GuardedMesh& surface, QuadTable& table, const QuadLoop& loop)
{
    std::vector<std::uint32_t> middle;
    for (const auto& [a, b] : loop.rungs) {
        const Vec3d p = surface.point(a), q = surface.point(b);
        middle.push_back(surface.vertices());
        if (!applyNear(surface, starOfSplit(surface, a, b), 0.5 * (p + q), (p - q).length(), heights)) return {};
    }
    for (std::size_t i = 0; i < loop.quads.size(); ++i) {
        const std::size_t next = (i + 1) % loop.rungs.size();
        const auto [a, b] = loop.rungs[i];
        const auto [c, d] = loop.rungs[next];
        const std::uint32_t m = middle[i], n = middle[next];
        // Around the quad: a, m, b, d, n, c.
        const bool isOfA = faceAt(surface, d, a) != GuardedMesh::none;
        if (!(isOfA ? join(surface, m, d, a) : join(surface, m, b, c))) return {};
        table.replace(loop.quads[i], Vec4I(a, m, n, c));
        table.add(Vec4I(m, b, d, n));
    }
    return middle;
}

} // namespace vdbcage::detail
