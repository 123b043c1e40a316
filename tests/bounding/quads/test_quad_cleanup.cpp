// Local changes that bring vertices nearer to four edges. Valences are counted on meshes, by code that knows nothing of
// the table of quads.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/quad_change.h>
#include <vdbcage/bounding/detail/quads/quad_cleanup.h>
#include <vdbcage/bounding/detail/quads/quad_making.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/pi.h>

#include "bounding/support/lump.h"
#include "bounding/support/manifold.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec3d;
using openvdb::Vec4I;

namespace {

/// The surface of a lump, some of its quads two triangles.
struct Patchwork {
    explicit Patchwork(unsigned seed) : lump(seed), surface(lump.surface, modelOf(lump.guard)), table(surface)
    {
        std::mt19937 random(seed);
        for (std::uint32_t q = 0; q < table.quads(); ++q) {
            if (random() % 5 == 0) table.remove(q);
        }
    }

    test::Lump lump;
    GuardedMesh surface;
    QuadTable table;
};

/// The polygons, by numbers of vertices: quads of the table, and the faces that are in none.
std::vector<std::vector<std::uint32_t>> polygonsOf(const GuardedMesh& surface, const QuadTable& table)
{
    std::vector<std::vector<std::uint32_t>> polygons;
    std::set<std::set<std::uint32_t>> halves; // of quads, under either diagonal
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q)) continue;
        const Vec4I& ids = table.corners(q);
        polygons.push_back({ids[0], ids[1], ids[2], ids[3]});
        for (int i = 0; i < 4; ++i) halves.insert({ids[i], ids[(i + 1) % 4], ids[(i + 2) % 4]});
    }
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (!surface.isFace(f)) continue;
        const auto& t = surface.face(f);
        if (halves.count({t[0], t[1], t[2]}) == 0) polygons.push_back({t[0], t[1], t[2]});
    }
    return polygons;
}

std::map<std::uint32_t, std::size_t> valencesOf(const std::vector<std::vector<std::uint32_t>>& polygons)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i)
            edges.insert(std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]));
    }
    std::map<std::uint32_t, std::size_t> valences;
    for (const auto& [a, b] : edges) {
        ++valences[a];
        ++valences[b];
    }
    return valences;
}

double irregularityOf(const GuardedMesh& surface, const QuadTable& table)
{
    double sum = 0;
    for (const auto& entry : valencesOf(polygonsOf(surface, table))) sum += irregularity(entry.second);
    return sum;
}

/// Of a cage: the share of vertices without four edges, and the mean deviation of quads' corners from square, in
/// degrees.
struct Shape {
    explicit Shape(const Mesh& cage)
    {
        std::vector<std::vector<std::uint32_t>> polygons;
        for (const auto& t : cage.triangles) polygons.push_back({t[0], t[1], t[2]});
        for (const auto& q : cage.quads) polygons.push_back({q[0], q[1], q[2], q[3]});
        const auto valences = valencesOf(polygons);
        irregular =
            double(std::count_if(valences.begin(), valences.end(), [](const auto& v) { return v.second != 4; })) /
            double(valences.size());
        double sum = 0;
        for (const auto& q : cage.quads) {
            for (int i = 0; i < 4; ++i) {
                const Vec3d u = (cage.points[q[(i + 1) % 4]] - cage.points[q[i]]).unit(),
                            w = (cage.points[q[(i + 3) % 4]] - cage.points[q[i]]).unit();
                sum += std::abs(std::acos(std::clamp(u.dot(w), -1.0, 1.0)) * 180 / pi - 90);
            }
        }
        angle = sum / double(4 * cage.quads.size());
    }

    double irregular, angle;
};

} // namespace

BOOST_AUTO_TEST_SUITE(quad_cleanup)

BOOST_AUTO_TEST_CASE(changes_gain_what_they_say)
{
    std::map<QuadChange::Kind, int> made;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Patchwork before(seed);
        const double irregular = irregularityOf(before.surface, before.table);
        const std::size_t faces = polygonsOf(before.surface, before.table).size();
        for (const QuadChange& change : quadChanges(before.surface, before.table, -3)) {
            const auto plan = planned(before.surface, before.table, change);
            if (!plan || made[change.kind] >= 40 * int(seed)) continue;
            GuardedMesh surface = before.surface;
            QuadTable table = before.table;
            if (!applyNear(surface, plan->star, plan->place, 1, {0.0, 0.05, 0.1, 0.2})) continue;
            apply(table, *plan);
            ++made[change.kind];
            const auto polygons = polygonsOf(surface, table);
            Mesh mesh = surface.mesh();
            BOOST_CHECK(test::isClosedManifold(mesh));
            BOOST_TEST(surface.liveFaces() - table.count() == polygons.size()); // each quad is two of the faces
            const int more = int(polygons.size()) - int(faces);
            BOOST_TEST(more == (change.kind == QuadChange::Kind::rotation ? 0
                                : change.kind == QuadChange::Kind::split  ? 1
                                                                          : -1));
            BOOST_TEST(std::abs(irregular - irregularityOf(surface, table) - change.gain) < 1e-9);
            for (const auto& entry : valencesOf(polygons)) {
                BOOST_TEST(polygonValence(surface, table, entry.first) == entry.second);
            }
        }
    }
    for (const auto kind :
         {QuadChange::Kind::rotation, QuadChange::Kind::merge, QuadChange::Kind::collapse, QuadChange::Kind::split}) {
        BOOST_TEST(made[kind] > 20);
    }
}

BOOST_AUTO_TEST_CASE(a_change_that_is_taken_back_leaves_no_trace)
{
    int taken = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Patchwork before(seed);
        GuardedMesh surface = before.surface;
        QuadTable table = before.table;
        for (const QuadChange& change : quadChanges(before.surface, before.table, -0.5)) {
            const auto plan = planned(surface, table, change);
            if (!plan) continue;
            std::vector<std::uint32_t> around = plan->vertices;
            for (const auto& edge : plan->star.link) around.insert(around.end(), edge.begin(), edge.end());
            const auto savedFaces = surface.saved(plan->star);
            const auto savedQuads = table.saved(around);
            if (!applyNear(surface, plan->star, plan->place, 1, {0.0, 0.05, 0.1, 0.2})) continue;
            apply(table, *plan);
            table.restore(savedQuads);
            surface.restore(savedFaces);
            ++taken;
            BOOST_CHECK(test::sameMesh(surface.mesh(), before.surface.mesh()));
            BOOST_TEST(surface.liveFaces() == before.surface.liveFaces());
            BOOST_TEST(table.count() == before.table.count());
            for (std::uint32_t v = 0; v < before.surface.vertices(); ++v) {
                if (surface.facesOf(v) != before.surface.facesOf(v) || table.quadsOf(v) != before.table.quadsOf(v))
                    BOOST_ERROR("vertex " << v << " is not as before");
            }
        }
    }
    BOOST_TEST(taken > 100);
}

BOOST_AUTO_TEST_CASE(what_was_found_before_another_change_is_planned_as_it_was_meant_or_not_at_all)
{
    std::map<QuadChange::Kind, int> made, refused;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Patchwork before(seed);
        const auto changes = quadChanges(before.surface, before.table, -1);
        for (std::size_t i = seed; i < changes.size(); i += 7) {
            const auto first = planned(before.surface, before.table, changes[i]);
            if (!first) continue;
            GuardedMesh changed = before.surface;
            QuadTable changedTable = before.table;
            if (!applyNear(changed, first->star, first->place, 1, {0.0, 0.05, 0.1, 0.2})) continue;
            apply(changedTable, *first);
            const std::set<std::uint32_t> near(first->vertices.begin(), first->vertices.end());
            const std::size_t count = polygonsOf(changed, changedTable).size();
            for (const QuadChange& change : changes) {
                if (near.count(change.vertices[0]) + near.count(change.vertices[1]) < 2) continue;
                const auto plan = planned(changed, changedTable, change);
                if (!plan) ++refused[change.kind];
                GuardedMesh surface = changed;
                QuadTable table = changedTable;
                if (!plan || !applyNear(surface, plan->star, plan->place, 1, {0.0, 0.05, 0.1, 0.2})) continue;
                apply(table, *plan);
                if (std::isinf(irregularityOf(surface, table))) continue; // what it would gain now says so
                ++made[change.kind];
                const std::size_t polygons = polygonsOf(surface, table).size();
                BOOST_TEST(polygons == surface.liveFaces() - table.count()); // each quad is two of the faces
                BOOST_TEST(int(polygons) - int(count) == (change.kind == QuadChange::Kind::rotation ? 0
                                                          : change.kind == QuadChange::Kind::split  ? 1
                                                                                                    : -1));
            }
        }
    }
    for (const auto kind :
         {QuadChange::Kind::rotation, QuadChange::Kind::merge, QuadChange::Kind::collapse, QuadChange::Kind::split}) {
        BOOST_TEST(made[kind] > 0);
        BOOST_TEST(refused[kind] > 0);
    }
}

BOOST_AUTO_TEST_CASE(quads_that_cannot_be_made_are_told)
{
    for (const auto make : {makeQuads, makeQuadsInPlace}) {
        std::size_t told = 0, made = 0;
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const test::Lump lump(seed);
            GuardedMesh surface(lump.surface, modelOf(lump.guard));
            QuadTable table = QuadTable::ofPairs(surface);
            std::vector<char> isTaken(surface.faces(), 0);
            for (std::uint32_t f = 0; f < surface.faces(); ++f) { // any two that share an edge
                for (unsigned i = 0; i < 3 && !isTaken[f]; ++i) {
                    const std::uint32_t g = faceAcross(surface, f, int((seed + f + i) % 3));
                    if (isTaken[g]) continue;
                    isTaken[f] = isTaken[g] = 1;
                    table.add(surface.quadOf(f, g));
                }
            }
            std::vector<std::uint32_t> left = make(surface, table, nullptr), lacking;
            for (std::uint32_t q = 0; q < table.quads(); ++q) {
                const Vec4I& ids = table.corners(q);
                const std::uint32_t f = faceAt(surface, ids[0], ids[1]), g = faceAt(surface, ids[2], ids[3]);
                if (!surface.isInQuad(f) || surface.partnerOf(f) != g) lacking.push_back(q);
            }
            std::sort(left.begin(), left.end());
            BOOST_TEST(left == lacking);
            BOOST_TEST(surface.quads() == table.count() - left.size());
            told += left.size();
            made += surface.quads();
        }
        BOOST_TEST(told > 0U);
        BOOST_TEST(made > 0U);
    }
}

BOOST_AUTO_TEST_CASE(valences_get_better_and_the_surface_still_bounds)
{
    for (unsigned seed = 1; seed <= 4; ++seed) {
        Patchwork now(seed);
        const double before = irregularityOf(now.surface, now.table);
        const std::size_t most = polygonsOf(now.surface, now.table).size() - 5 * (seed % 2); // fewer for some
        cleanUp(now.surface, now.table, most, nullptr);
        const Mesh mesh = now.surface.mesh();
        BOOST_TEST(irregularityOf(now.surface, now.table) < 0.9 * before);
        BOOST_TEST(polygonsOf(now.surface, now.table).size() <= most);
        BOOST_CHECK(test::isClosedManifold(mesh));
        BOOST_TEST(checkCage(mesh, now.lump.model).bounding());
        for (const auto& entry : valencesOf(polygonsOf(now.surface, now.table))) BOOST_TEST(entry.second >= 3U);
    }
}

BOOST_AUTO_TEST_CASE(quad_shape_trades_distance_for_square_corners)
{
    double irregular[3] = {}, angle[3] = {}, distance[3] = {};
    for (const unsigned seed : {1U, 2U, 3U}) {
        const Mesh model = test::soup(seed, 40, 0.1);
        const BoundingGuard guard(model);
        const Mesh fine = decimate(test::ball(24), guard, test::to(360));
        int i = 0;
        for (const double shape : {0.0, 0.5, 1.0}) {
            BoundingTriquadOptions options = test::quads(120, 90);
            options.quads = 0.85;
            options.quadShape = shape;
            const Mesh cage = triquad(fine, guard, options);
            const CageCheck check = checkCage(cage, model);
            BOOST_TEST(check.bounding());
            BOOST_TEST(faceCount(cage) <= 120U);
            BOOST_TEST(double(cage.quads.size()) >= 0.85 * double(faceCount(cage)));
            irregular[i] += Shape(cage).irregular;
            angle[i] += Shape(cage).angle;
            distance[i++] += check.meanDistance;
        }
    }
    BOOST_TEST(irregular[1] < 0.85 * irregular[0]);
    BOOST_TEST(angle[1] < 0.85 * angle[0]);
    BOOST_TEST(angle[2] < 0.95 * angle[1]);
    BOOST_TEST(distance[1] < 1.1 * distance[0]);
}

BOOST_AUTO_TEST_CASE(symmetric_cages_are_cleaned_up_too)
{
    const Mesh half =
        test::joined(test::sphere({0.2, 0.05, 0}, 0.15, 10), test::box({-0.02, -0.3, -0.1}, {0.05, 0.1, 0.1}));
    const SymmetryPlane plane{0, 0};
    const Mesh model = test::joined(half, test::mirrored(half, plane));
    GuardOptions guarding;
    guarding.symmetry = plane;
    const BoundingGuard guard(model, guarding);
    const Mesh fine = decimate(guard.symmetrized(test::ball(24), 0.25 / 24), guard, test::to(360));
    BoundingTriquadOptions options = test::quads(120, 90);
    options.quads = 0.85;
    options.quadShape = 0;
    const Mesh before = triquad(fine, guard, options);
    options.quadShape = 0.5;
    const Mesh cage = triquad(fine, guard, options);
    BOOST_CHECK(test::isSymmetric(cage, *guard.symmetry()));
    BOOST_TEST(checkCage(cage, model).bounding());
    BOOST_TEST(Shape(cage).irregular < 0.9 * Shape(before).irregular);
    BOOST_TEST(Shape(cage).angle < 0.9 * Shape(before).angle);
}

BOOST_AUTO_TEST_SUITE_END()
