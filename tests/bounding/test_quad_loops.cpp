// Cages of quads in loops, and what they are made by. Loops and surfaces are examined by code that knows nothing of the
// table of quads.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/loops/loop_collapse.h>
#include <vdbcage/bounding/detail/loops/loop_split.h>
#include <vdbcage/bounding/detail/quads/quad_shape_term.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

#include "support/lump.h"
#include "support/manifold.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/spacing.h"
#include "support/stop_at.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec3d;
using openvdb::Vec4I;

namespace {

QuadLoopsOptions to(std::size_t faces)
{
    QuadLoopsOptions options;
    options.faces = faces;
    return options;
}

bool same(const Mesh& a, const Mesh& b)
{
    return a.points == b.points && a.triangles == b.triangles && a.quads == b.quads;
}

/// The quads of a mesh, joined across opposite sides: for each closed loop how often it passes which quad.
std::vector<std::map<std::size_t, int>> loopsByUnion(const Mesh& mesh)
{
    using Side = std::pair<openvdb::Index32, openvdb::Index32>;
    std::map<Side, std::size_t> number;
    std::vector<std::size_t> root;
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i];
        return i;
    };
    const auto sideOf = [&](const Vec4I& q, int i) {
        const auto [a, b] = std::minmax({q[i], q[(i + 1) % 4]});
        const auto added = number.emplace(Side(a, b), root.size());
        if (added.second) root.push_back(root.size());
        return added.first->second;
    };
    for (const Vec4I& q : mesh.quads) {
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

bool isSimple(const std::map<std::size_t, int>& loop)
{
    return std::all_of(loop.begin(), loop.end(), [](const auto& pass) { return pass.second == 1; });
}

/// The part of the quads that is on a loop that passes no quad twice.
double loopShare(const Mesh& mesh)
{
    std::set<std::size_t> on;
    for (const auto& loop : loopsByUnion(mesh)) {
        if (!isSimple(loop)) continue;
        for (const auto& pass : loop) on.insert(pass.first);
    }
    return double(on.size()) / double(mesh.quads.size());
}

/// A surface with its table and quadrics.
struct Working {
    explicit Working(const Mesh& mesh, const BoundingGuard& guard)
        : surface(mesh, modelOf(guard)), table(surface), quadrics(surface)
    {
    }
    std::vector<Vec4I> quads() const
    {
        std::vector<Vec4I> list;
        for (std::uint32_t q = 0; q < table.quads(); ++q) {
            if (table.isQuad(q)) list.push_back(table.corners(q));
        }
        return list;
    }

    GuardedMesh surface;
    QuadTable table;
    VertexQuadrics quadrics;
};

/// Whether the surface has two faces for each quad of the table, on both sides of one of its diagonals.
bool twoFacesMakeEach(const Working& now)
{
    for (const Vec4I& q : now.quads()) {
        const std::uint32_t f = faceAt(now.surface, q[0], q[1]), g = faceAt(now.surface, q[2], q[3]);
        if (f == GuardedMesh::none || g == GuardedMesh::none || f == g) return false;
        const std::uint32_t tip = cornerOpposite(now.surface, f, q[0], q[1]),
                            other = cornerOpposite(now.surface, g, q[2], q[3]);
        const bool isFirst = tip == q[2] && other == q[0], isSecond = tip == q[3] && other == q[1];
        if (!isFirst && !isSecond) return false;
    }
    return true;
}

bool same(const Quadric& a, const Quadric& b)
{
    const auto cost = [](const Quadric& q, const Vec3d& p) { return q.cost(p, 1); };
    return cost(a, {0, 0, 0}) == cost(b, {0, 0, 0}) && cost(a, {1, 2, 3}) == cost(b, {1, 2, 3}) &&
           cost(a, {-3, 1, 2}) == cost(b, {-3, 1, 2});
}

/// To the bit, with the order of all lists.
bool same(const Working& a, const Working& b)
{
    if (!same(a.surface.mesh(), b.surface.mesh()) || a.quads() != b.quads() || a.table.count() != b.table.count())
        return false;
    if (a.surface.vertices() != b.surface.vertices() || a.surface.liveFaces() != b.surface.liveFaces()) return false;
    for (std::uint32_t v = 0; v < a.surface.vertices(); ++v) {
        if (a.surface.facesOf(v) != b.surface.facesOf(v) || a.table.quadsOf(v) != b.table.quadsOf(v)) return false;
        if (a.surface.point(v) != b.surface.point(v) || !same(a.quadrics.of(v), b.quadrics.of(v))) return false;
    }
    for (std::uint32_t f = 0; f < a.surface.faces(); ++f) {
        if (a.surface.isFace(f) != b.surface.isFace(f)) return false;
        if (a.surface.isFace(f) && a.surface.face(f) != b.surface.face(f)) return false;
    }
    return true;
}

/// Whether the tree of the surface finds every face, and none that is gone.
bool treeIsRight(const GuardedMesh& surface)
{
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        bool found = false;
        const Box box = surface.isFace(f) ? Box::of(surface.corners(f)) : Box::of(Vec3d(0.0));
        const bool allLive = surface.tree().forEachOverlap(box, [&](std::uint32_t other, const Box& at) {
            found = found || (other == f && at.lo == box.lo && at.hi == box.hi);
            return surface.isFace(other);
        });
        if (!allLive || found != surface.isFace(f)) return false;
    }
    return true;
}

/// The quads that are left where the rungs of a loop become points, by their numbers alone.
Mesh contracted(const QuadTable& table, const QuadLoop& loop, std::size_t points)
{
    std::vector<openvdb::Index32> root(points);
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](openvdb::Index32 i) {
        while (root[i] != i) i = root[i];
        return i;
    };
    for (const Rung& rung : loop.rungs) root[find(rung[0])] = find(rung[1]);
    const std::set<std::uint32_t> gone(loop.quads.begin(), loop.quads.end());
    Mesh mesh;
    std::map<openvdb::Index32, openvdb::Index32> number;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q) || gone.count(q) > 0) continue;
        Vec4I ids;
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
bool isOfQuads(const Mesh& mesh)
{
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, std::vector<std::size_t>> at;
    std::vector<int> valence(mesh.points.size(), 0);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Vec4I& ids = mesh.quads[q];
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
    return test::isClosedManifold(mesh) &&
           std::all_of(valence.begin(), valence.end(), [](int edges) { return edges >= 3; });
}

std::vector<Mesh> models()
{
    return {test::sphere({0, 0, 0}, 0.4, 12), test::box({-0.3, -0.2, -0.1}, {0.2, 0.2, 0.2}),
            test::torus(0.3, 0.08, 24, 10), test::soup(1, 30, 0.1),
            test::joined(test::box({-0.2, -0.2, -0.2}, {0, 0, 0}), test::box({0, 0, 0}, {0.2, 0.2, 0.2}))};
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_loops)

BOOST_DATA_TEST_CASE(every_cage_bounds_its_model, boost::unit_test::data::make({6, 30, 120}), faces)
{
    int reached = 0;
    for (const Mesh& model : models()) {
        const BoundingGuard guard(model);
        const Mesh cage = quadLoops(test::ball(12), guard, to(std::size_t(faces)));
        BOOST_TEST(checkCage(cage, model).bounding()); // under both diagonals
        BOOST_TEST(guard.facesTooNear(cage).empty());
        BOOST_TEST(test::pairsTooNear(cage, guard) == 0U);
        BOOST_TEST(test::isClosedManifold(cage));
        if (!cage.triangles.empty()) continue;
        BOOST_TEST(loopShare(cage) >= 0.9);
        reached += cage.quads.size() <= std::size_t(faces);
    }
    BOOST_TEST(reached >= (faces == 6 ? 1 : 3)); // of 5
}

BOOST_AUTO_TEST_CASE(a_box_is_six_quads_and_tight)
{
    const Vec3d half(0.3, 0.25, 0.2);
    const Mesh model = test::box(-half, half);
    const BoundingGuard guard(model);
    const Mesh start = extractSurface(*test::sample(
        12, [&](const Vec3d& p) { return std::abs(p.x()) < 0.4 && std::abs(p.y()) < 0.35 && std::abs(p.z()) < 0.3; }));
    const Mesh cage = quadLoops(start, guard, to(6));
    BOOST_TEST(cage.quads.size() == 6U);
    BOOST_TEST(cage.triangles.empty());
    const CageCheck check = checkCage(cage, model);
    BOOST_TEST(check.bounding());
    BOOST_TEST(check.meanDistance < 0.001);
}

BOOST_AUTO_TEST_CASE(corners_get_squarer_where_that_is_asked)
{
    const Mesh model = test::torus(0.3, 0.08, 24, 10);
    GuardOptions slender;
    slender.minAngleDegrees = 1;
    const BoundingGuard guard(model, slender);
    const auto angles = [&](double mean) {
        QuadLoopsOptions options = to(150);
        options.meanAngleDegrees = mean;
        options.mostAngleDegrees = 90;
        const GuardedMesh surface(quadLoops(test::ball(16), guard, options), modelOf(guard));
        return cornerAngles(surface, QuadTable(surface));
    };
    const CornerAngles any = angles(90), square = angles(10);
    BOOST_TEST(square.mean < any.mean - 2);
    BOOST_TEST(square.mean < 17);
    BOOST_TEST(any.mostOf95 > any.mean);
}

BOOST_AUTO_TEST_CASE(symmetric_cages_stay_symmetric)
{
    const Mesh model = test::joined(test::sphere({-0.2, 0, 0}, 0.15, 10), test::sphere({0.2, 0, 0}, 0.15, 10));
    const BoundingGuard guard = test::guardOf(model, true);
    const Mesh start = guard.symmetrized(test::ball(14), 0.25 / 14);
    const Mesh cage = quadLoops(start, guard, to(80));
    BOOST_TEST(checkCage(cage, model).bounding());
    BOOST_TEST(cage.triangles.empty());
    BOOST_TEST(cage.quads.size() <= 80U);
    std::set<std::array<double, 3>> points;
    for (const Vec3d& p : cage.points) points.insert({p.x(), p.y(), p.z()});
    for (const Vec3d& p : cage.points) BOOST_TEST(points.count({-p.x(), p.y(), p.z()}) == 1U);
}

BOOST_AUTO_TEST_CASE(loops_are_those_that_the_sides_join)
{
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const Working now(lump.surface, lump.guard);
        std::multiset<std::set<std::size_t>> expected, found;
        for (const auto& loop : loopsByUnion(lump.surface)) {
            if (!isSimple(loop)) continue;
            std::set<std::size_t> quads;
            for (const auto& pass : loop) quads.insert(pass.first);
            expected.insert(quads);
        }
        for (const QuadLoop& loop : straightLoops(now.table)) {
            BOOST_TEST(loop.isClosed());
            found.insert({loop.quads.begin(), loop.quads.end()});
            for (std::size_t i = 0; i < loop.quads.size();
                 ++i) { // each rung is a side of the quads before and after it
                const auto [a, b] = loop.rungs[i];
                BOOST_TEST(now.table.sideOf(loop.quads[i], a, b) < 4);
                BOOST_TEST(now.table.sideOf(loop.quads[(i + loop.quads.size() - 1) % loop.quads.size()], b, a) < 4);
            }
        }
        BOOST_TEST(!expected.empty());
        BOOST_CHECK(found == expected);
    }
}

BOOST_AUTO_TEST_CASE(a_loop_may_go_if_quads_are_left)
{
    int mayGo = 0, mayNot = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(now.table)) {
            const bool may = leavesQuads(now.surface, now.table, loop);
            (may ? mayGo : mayNot) += 1;
            if (may) BOOST_TEST(isOfQuads(contracted(now.table, loop, lump.surface.points.size())));
        }
    }
    BOOST_TEST(mayGo > 50);
    BOOST_TEST(mayNot > 50);
    int turning = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : turningLoops(now.surface, now.table)) {
            if (!leavesQuads(now.surface, now.table, loop)) continue;
            ++turning;
            const Mesh left = contracted(now.table, loop, lump.surface.points.size());
            BOOST_TEST(isOfQuads(left));
            BOOST_TEST(left.quads.size() == now.table.count() - loop.quads.size());
        }
    }
    BOOST_TEST(turning > 50);
    // A bar of one voxel's width: rings of four quads. Without a loop along it two would be left, with two sides in
    // common.
    auto bar = openvdb::MaskGrid::create();
    for (int x = 0; x < 5; ++x) bar->tree().setValueOn(openvdb::Coord(x, 0, 0));
    const BoundingGuard guard(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const Working now(extractSurface(*bar), guard);
    int rings = 0;
    for (const QuadLoop& loop : straightLoops(now.table)) {
        const bool isRing = loop.quads.size() == 4;
        rings += isRing;
        BOOST_TEST(leavesQuads(now.surface, now.table, loop) == isRing);
    }
    BOOST_TEST(rings == 5);
}

BOOST_AUTO_TEST_CASE(what_is_collapsed_is_what_the_rungs_join)
{
    int collapsed = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const Working before(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            Working now(lump.surface, lump.guard);
            if (!collapseLoop(now.surface, now.table, now.quadrics, loop, [](const auto&) { return true; })) continue;
            ++collapsed;
            BOOST_TEST(now.table.count() == before.table.count() - loop.quads.size());
            BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
            BOOST_TEST(checkCage(now.surface.mesh(), lump.model).bounding());
            BOOST_TEST(treeIsRight(now.surface));
            BOOST_TEST(twoFacesMakeEach(now));
        }
    }
    BOOST_TEST(collapsed > 30);
}

BOOST_AUTO_TEST_CASE(a_collapse_that_is_not_accepted_leaves_no_trace)
{
    int refused = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const Working before(lump.surface, lump.guard);
        Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            const bool done = collapseLoop(now.surface, now.table, now.quadrics, loop, [&](const auto&) {
                ++refused;
                return false;
            });
            BOOST_TEST(!done);
            BOOST_CHECK(same(before, now));
            BOOST_TEST(treeIsRight(now.surface));
        }
    }
    BOOST_TEST(refused > 30);
}

BOOST_AUTO_TEST_CASE(a_collapse_that_the_guard_stops_leaves_no_trace)
{
    // Specks in the corners of the voxels hold the surface: some rungs may go, others not.
    int stopped = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        Mesh specks = lump.model;
        const auto grid = test::Lump::solid(seed);
        for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
            const Vec3d centre = grid->indexToWorld(voxel.getCoord());
            for (int i = 0; i < 6; ++i) {
                const Vec3d p = centre + 0.9 * (Vec3d(unit(random), unit(random), unit(random)) - Vec3d(0.5));
                specks = test::joined(specks, test::box(p - Vec3d(0.02), p + Vec3d(0.02)));
            }
        }
        const BoundingGuard guard(specks, test::Lump::close());
        if (!guard.facesTooNear(lump.surface).empty()) continue;
        const Working before(lump.surface, guard);
        Working now(lump.surface, guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            bool wasAsked = false;
            collapseLoop(now.surface, now.table, now.quadrics, loop, [&](const auto&) {
                wasAsked = true;
                return false;
            });
            stopped += !wasAsked;
            BOOST_CHECK(same(before, now));
        }
    }
    BOOST_TEST(stopped > 10);
}

BOOST_AUTO_TEST_CASE(a_loop_that_is_split_is_two_loops)
{
    int split = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const Working before(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            Working now(lump.surface, lump.guard);
            const std::vector<std::uint32_t> middle = splitLoop(now.surface, now.table, loop);
            if (middle.empty()) continue;
            ++split;
            BOOST_TEST(middle.size() == loop.rungs.size());
            BOOST_TEST(now.table.count() == before.table.count() + loop.quads.size());
            BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
            Mesh quads;
            for (std::uint32_t v = 0; v < now.surface.vertices(); ++v) quads.points.push_back(now.surface.point(v));
            quads.quads = now.quads();
            BOOST_TEST(isOfQuads(quads));
            BOOST_TEST(loopsByUnion(quads).size() == loopsByUnion(lump.surface).size() + 1);
            BOOST_TEST(twoFacesMakeEach(now));
            BOOST_TEST(checkCage(now.surface.mesh(), lump.model).bounding());
        }
    }
    BOOST_TEST(split > 50);
}

BOOST_AUTO_TEST_CASE(a_loop_from_plane_to_plane_is_split_too)
{
    constexpr int resolution = 8;
    const Mesh model = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    const BoundingGuard guard = test::guardOf(model, true);
    const Mesh half = guard.symmetrized(test::ball(resolution), 0.25 / resolution);
    const Working before(half, guard);
    int split = 0;
    for (const QuadLoop& loop : straightLoops(before.table)) {
        if (loop.isClosed()) continue;
        BOOST_TEST(loop.rungs.size() == loop.quads.size() + 1);
        Working now(half, guard);
        if (splitLoop(now.surface, now.table, loop).empty()) continue;
        ++split;
        BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
        BOOST_TEST(twoFacesMakeEach(now));
        BOOST_TEST(checkCage(now.surface.mesh(), model).bounding());
    }
    BOOST_TEST(split > 5);
}

BOOST_AUTO_TEST_CASE(exchanged_loops_bring_a_surface_nearer)
{
    double before = 0, after = 0;
    for (const Mesh& model : {test::torus(0.3, 0.08, 24, 10), test::box({-0.3, -0.2, -0.1}, {0.2, 0.2, 0.2})}) {
        const BoundingGuard guard(model);
        for (const int exchanges : {0, 4}) {
            QuadLoopsOptions options = to(100);
            options.exchanges = exchanges;
            const Mesh cage = quadLoops(test::ball(14), guard, options);
            BOOST_TEST(cage.quads.size() <= 100U);
            (exchanges == 0 ? before : after) += checkCage(cage, model).meanDistance;
        }
    }
    BOOST_TEST(after < before);
}

BOOST_AUTO_TEST_CASE(the_shape_s_slope_is_that_of_its_sum)
{
    const test::Lump lump(3);
    GuardedMesh surface(lump.surface, modelOf(lump.guard));
    const QuadTable table(surface);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const ShapeWeights& weights :
         {ShapeWeights{1, 0.1, 0, 0, 0}, ShapeWeights{0, 0, 1, 0, 0}, ShapeWeights{0, 0, 0, 1, 0}}) {
        const QuadShapeTerm shape(table, weights);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            const Vec3d p = surface.point(v) + 0.05 * Vec3d(unit(random), unit(random), unit(random));
            Quadratic change, ignored;
            const double sum = shape.add(surface, star, p, change);
            for (int i = 0; i < 3; ++i) {
                constexpr double step = 1e-6;
                Vec3d there = p, back = p;
                there[i] += step;
                back[i] -= step;
                const double slope =
                    (shape.add(surface, star, there, ignored) - shape.add(surface, star, back, ignored)) / (2 * step);
                // That of the fold leaves out how its scale changes.
                const double slack = weights.flat > 0 ? 0.3 * change.slope.length() + 0.1 * sum : 1e-5;
                BOOST_TEST(std::abs(slope - change.slope[i]) <= slack + 1e-6);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = test::soup(4, 60, 0.1);
    const BoundingGuard guard(model);
    const auto make = [&] { return quadLoops(test::ball(14), guard, to(60)); };
    const Mesh many = make();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(same(many, make()));
}

BOOST_AUTO_TEST_CASE(cancelling_at_any_question_throws)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8), start = test::ball(7);
    const BoundingGuard guard(model);
    test::StopAt never(1000000);
    quadLoops(start, guard, to(40), {}, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 50);
    for (int i = 0; i < 50; ++i) {
        test::StopAt stop(asked * i / 50);
        BOOST_CHECK_THROW(quadLoops(start, guard, to(40), {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(progress_grows)
{
    struct Watcher : Interrupter {
        bool wasInterrupted(int percent) override
        {
            if (percent < 0) return false;
            grows = grows && percent >= last && percent <= 100;
            last = std::max(last, percent);
            ++times;
            return false;
        }
        bool grows = true;
        int last = 0, times = 0;
    } watcher;
    // A long bar: its rings are so short that loops go one by one, also where they are exchanged.
    auto bar = openvdb::MaskGrid::create();
    bar->fill(openvdb::CoordBBox({0, 0, 0}, {39, 2, 2}), true);
    bar->tree().voxelizeActiveTiles();
    const BoundingGuard guard(test::box({0, 0, 0}, {39, 2, 2}));
    quadLoops(extractSurface(*bar), guard, to(150), {}, &watcher);
    BOOST_TEST(watcher.grows);
    BOOST_TEST(watcher.times > 5);
    BOOST_TEST(watcher.last >= 70);
}

BOOST_AUTO_TEST_CASE(bad_options_and_surfaces_are_refused)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8);
    const BoundingGuard guard(model);
    BOOST_CHECK_THROW(quadLoops(test::ball(), guard, to(5)), InputError);
    QuadLoopsOptions options;
    options.tightening.sweeps = -1;
    BOOST_CHECK_THROW(quadLoops(test::ball(), guard, options), InputError);
    options = {};
    options.exchanges = -1;
    BOOST_CHECK_THROW(quadLoops(test::ball(), guard, options), InputError);
    for (const double angle : {-1.0, 91.0}) {
        options = {};
        options.meanAngleDegrees = angle;
        BOOST_CHECK_THROW(quadLoops(test::ball(), guard, options), InputError);
        options = {};
        options.mostAngleDegrees = angle;
        BOOST_CHECK_THROW(quadLoops(test::ball(), guard, options), InputError);
    }
    const Mesh withTriangles = test::sphere({0, 0, 0}, 0.6, 8);
    BOOST_CHECK_THROW(quadLoops(withTriangles, guard, to(40)), InputError);
    Mesh inPairs = test::ball(); // which might be taken for quads
    inPairs.triangles = triangulate(inPairs);
    inPairs.quads.clear();
    BOOST_CHECK_THROW(quadLoops(inPairs, guard, to(40)), InputError);
    Mesh open = test::ball();
    open.quads.pop_back();
    BOOST_CHECK_THROW(quadLoops(open, guard, to(40)), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
