#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <bounding/support/guarded_surface.h>
#include <bounding/support/manifold.h>
#include <support/shapes.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/quad_loop.h>
#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>

/// Surfaces of quads in a table, and their loops, by code that knows nothing of the table.
namespace vdbcage::test {

/// The quads of a mesh, joined across opposite sides: for each closed loop how often it passes which quad.
inline std::vector<std::map<std::size_t, int>> loopsByUnion(const Mesh& mesh)
{
    using Side = std::pair<openvdb::Index32, openvdb::Index32>;
    std::map<Side, std::size_t> number;
    std::vector<std::size_t> root;
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i];
        return i;
    };
    const auto sideOf = [&](const openvdb::Vec4I& q, int i) {
        const auto [a, b] = std::minmax({q[i], q[(i + 1) % 4]});
        const auto added = number.emplace(Side(a, b), root.size());
        if (added.second) root.push_back(root.size());
        return added.first->second;
    };
    for (const openvdb::Vec4I& q : mesh.quads) {
        for (const int i : {0, 1}) {
            const std::size_t a = sideOf(q, i), b = sideOf(q, i + 2);
            root[find(a)] = find(b);
        }
    }
    std::map<std::size_t, std::map<std::size_t, int>> passes;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (const int i : {0, 1}) ++passes[find(sideOf(mesh.quads[q], i))][q];
    }
    std::vector<std::map<std::size_t, int>> loops;
    for (auto& loop : passes) loops.push_back(std::move(loop.second));
    return loops;
}

inline bool isSimple(const std::map<std::size_t, int>& loop)
{
    return std::all_of(loop.begin(), loop.end(), [](const auto& pass) { return pass.second == 1; });
}

/// A surface with its table and quadrics.
struct Working {
    explicit Working(const Mesh& mesh, const BoundingGuard& guard)
        : surface(mesh, detail::modelOf(guard)), table(surface), quadrics(surface)
    {
    }
    std::vector<openvdb::Vec4I> quads() const
    {
        std::vector<openvdb::Vec4I> list;
        for (std::uint32_t q = 0; q < table.quads(); ++q) {
            if (table.isQuad(q)) list.push_back(table.corners(q));
        }
        return list;
    }

    detail::GuardedMesh surface;
    detail::QuadTable table;
    detail::VertexQuadrics quadrics;
};

/// Whether the surface has two faces for each quad of the table, on both sides of one of its diagonals.
inline bool twoFacesMakeEach(const Working& now)
{
    for (const openvdb::Vec4I& q : now.quads()) {
        const std::uint32_t f = detail::faceAt(now.surface, q[0], q[1]), g = detail::faceAt(now.surface, q[2], q[3]);
        if (f == detail::GuardedMesh::none || g == detail::GuardedMesh::none || f == g) return false;
        const std::uint32_t tip = detail::cornerOpposite(now.surface, f, q[0], q[1]),
                            other = detail::cornerOpposite(now.surface, g, q[2], q[3]);
        const bool isFirst = tip == q[2] && other == q[0], isSecond = tip == q[3] && other == q[1];
        if (!isFirst && !isSecond) return false;
    }
    return true;
}

inline bool same(const detail::Quadric& a, const detail::Quadric& b)
{
    const auto cost = [](const detail::Quadric& q, const openvdb::Vec3d& p) { return q.cost(p, 1); };
    return cost(a, {0, 0, 0}) == cost(b, {0, 0, 0}) && cost(a, {1, 2, 3}) == cost(b, {1, 2, 3}) &&
           cost(a, {-3, 1, 2}) == cost(b, {-3, 1, 2});
}

/// Returns whether surfaces and quads are the same to the bit; numbers that are used up do not count.
inline bool sameSurface(const Working& a, const Working& b)
{
    return sameSurface(a.surface, b.surface) && a.quads() == b.quads() && a.table.count() == b.table.count();
}

/// Returns whether the lists of quads, the quadrics and the numbers of vertices are the same, too.
inline bool same(const Working& a, const Working& b)
{
    if (!sameSurface(a, b) || a.surface.vertices() != b.surface.vertices()) return false;
    for (std::uint32_t v = 0; v < a.surface.vertices(); ++v) {
        if (a.table.quadsOf(v) != b.table.quadsOf(v) || !same(a.quadrics.of(v), b.quadrics.of(v))) return false;
    }
    return true;
}

/// Returns the groups of vertices that become one where the rungs of a loop become points.
inline std::vector<std::set<std::uint32_t>> mergedGroups(const detail::QuadLoop& loop)
{
    std::vector<std::set<std::uint32_t>> groups;
    for (const detail::Rung& rung : loop.rungs) {
        std::set<std::uint32_t> group(rung.begin(), rung.end());
        for (std::size_t i = groups.size(); i-- > 0;) {
            if (groups[i].count(rung[0]) + groups[i].count(rung[1]) == 0) continue;
            group.insert(groups[i].begin(), groups[i].end());
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(i));
        }
        groups.push_back(group);
    }
    return groups;
}

/// The quads that are left where the rungs of a loop become points, by their numbers alone.
inline Mesh contracted(const detail::QuadTable& table, const detail::QuadLoop& loop, std::size_t points)
{
    std::vector<openvdb::Index32> root(points);
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](openvdb::Index32 i) {
        while (root[i] != i) i = root[i];
        return i;
    };
    for (const detail::Rung& rung : loop.rungs) root[find(rung[0])] = find(rung[1]);
    const std::set<std::uint32_t> gone(loop.quads.begin(), loop.quads.end());
    Mesh mesh;
    std::map<openvdb::Index32, openvdb::Index32> number;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q) || gone.count(q) > 0) continue;
        openvdb::Vec4I ids;
        for (int i = 0; i < 4; ++i)
            ids[i] = number.emplace(find(table.corners(q)[i]), openvdb::Index32(number.size())).first->second;
        mesh.quads.push_back(ids);
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::size_t i = 0; i < number.size(); ++i) mesh.points.emplace_back(unit(random), unit(random), unit(random));
    return mesh;
}

/// Closed, 2-manifold, every vertex with three edges and more, and no two quads with two sides in common.
inline bool isOfQuads(const Mesh& mesh)
{
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, std::vector<std::size_t>> at;
    std::vector<int> valence(mesh.points.size(), 0);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const openvdb::Vec4I& ids = mesh.quads[q];
        if (std::set<openvdb::Index32>{ids[0], ids[1], ids[2], ids[3]}.size() != 4) return false;
        for (int i = 0; i < 4; ++i) {
            ++valence[ids[i]];
            const auto [a, b] = std::minmax({ids[i], ids[(i + 1) % 4]});
            at[{a, b}].push_back(q);
        }
    }
    std::map<std::pair<std::size_t, std::size_t>, int> shared;
    for (const auto& side : at) {
        if (side.second.size() != 2) return false;
        if (++shared[{side.second[0], side.second[1]}] > 1) return false;
    }
    return isClosedManifold(mesh) && std::all_of(valence.begin(), valence.end(), [](int edges) { return edges >= 3; });
}

} // namespace vdbcage::test
