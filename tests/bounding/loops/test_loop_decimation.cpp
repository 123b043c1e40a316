// Loops that go and come in numbers: how many quads are left, that the table is the surface's, and how near it is.
#include <boost/test/unit_test.hpp>

#include <functional>
#include <set>
#include <vector>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/loops/add_rings.h>
#include <vdbcage/bounding/detail/loops/loop_decimation.h>
#include <vdbcage/bounding/detail/loops/loop_exchange.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>

#include "bounding/support/quad_surface.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

const Mesh model = test::soup(6, 30, 0.1);

test::Working start(const BoundingGuard& guard, int resolution = 9)
{
    const Mesh ball = test::ball(resolution);
    return test::Working(guard.symmetry() ? guard.symmetrized(ball, 0.25 / resolution) : ball, guard);
}

void requireGood(const test::Working& now, const BoundingGuard& guard)
{
    const Mesh mesh = now.surface.mesh();
    BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
    BOOST_TEST(test::twoFacesMakeEach(now));
    BOOST_TEST(test::isClosedManifold(mesh));
    BOOST_TEST(test::treeIsRight(now.surface));
    BOOST_TEST(checkCage(mesh, model).bounding());
    if (guard.symmetry()) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
}

/// A long bar of voxels, with a joint in it.
struct Bar {
    explicit Bar(double place)
        : guard(inside(), options()), surface(mesh(), modelOf(guard), GuardedMesh::Quads::split, wishes(place)),
          table(surface)
    {
    }
    static GuardOptions options()
    {
        GuardOptions options;
        options.minAngleDegrees = 1;
        return options;
    }
    static Mesh inside() { return test::box({-20, -1.5, -1.5}, {20, 1.5, 1.5}); }
    static Mesh mesh()
    {
        // Of few rings: the squares of a cross section, far apart.
        Mesh mesh;
        std::vector<std::array<int, 2>> rim;
        for (int i = -1; i < 1; ++i) rim.push_back({i, -1});
        for (int i = -1; i < 1; ++i) rim.push_back({1, i});
        for (int i = 1; i > -1; --i) rim.push_back({i, 1});
        for (int i = 1; i > -1; --i) rim.push_back({-1, i});
        const std::array<double, 5> places{-21, -11, -1, 9, 21};
        for (const double x : places) {
            for (const auto& at : rim) mesh.points.emplace_back(x, 2.0 * at[0], 2.0 * at[1]);
        }
        const auto number = [](openvdb::Index32 ring, openvdb::Index32 i) { return 8 * ring + i % 8; };
        for (openvdb::Index32 ring = 0; ring < 4; ++ring) {
            for (openvdb::Index32 i = 0; i < 8; ++i)
                mesh.quads.emplace_back(number(ring, i), number(ring, i + 1), number(ring + 1, i + 1),
                                        number(ring + 1, i));
        }
        for (const openvdb::Index32 ring : {0U, 4U}) {
            const auto middle = static_cast<openvdb::Index32>(mesh.points.size());
            mesh.points.emplace_back(places[ring], 0, 0);
            for (openvdb::Index32 i = 0; i < 8; i += 2) { // corners of the rim are even
                const openvdb::Index32 a = number(ring, i + 7), b = number(ring, i), c = number(ring, i + 1);
                if (ring == 0) mesh.quads.emplace_back(middle, c, b, a);
                if (ring == 4) mesh.quads.emplace_back(middle, a, b, c);
            }
        }
        return mesh;
    }
    FaceWishes wishes(double place) const
    {
        FaceWishOptions wishing;
        wishing.joints = {{Vec3d(place, 0, 0), Vec3d(1, 0, 0)}};
        return FaceWishes(guard, wishing);
    }

    BoundingGuard guard;
    GuardedMesh surface;
    QuadTable table;
};

/// How many rings of quads there are about a place: groups of vertices at one height, less one.
std::size_t levelsNear(const GuardedMesh& surface, double place, double reach)
{
    std::set<int> levels;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (!surface.isVertex(v)) continue;
        const double x = surface.guard().unscaled(surface.point(v))[0];
        if (std::abs(x - place) <= reach) levels.insert(static_cast<int>(std::lround(2 * x)));
    }
    return levels.size();
}

} // namespace

BOOST_AUTO_TEST_SUITE(loop_decimation)

BOOST_AUTO_TEST_CASE(at_most_as_many_quads_are_left_as_asked)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const test::Working before = start(guard);
        std::size_t last = before.table.count() + 1;
        for (const std::size_t quads : {before.table.count(), before.table.count() / 2, std::size_t(40)}) {
            test::Working now = start(guard);
            collapseLoops(now.surface, now.table, quads, AtJoints::anything, 0, nullptr);
            BOOST_TEST(now.table.count() <= quads);
            BOOST_TEST(now.table.count() < last);
            last = now.table.count();
            requireGood(now, guard);
            if (quads == before.table.count()) BOOST_TEST(test::sameSurface(now, before)); // nothing to do
        }
    }
}

BOOST_AUTO_TEST_CASE(a_loop_through_one_of_some_quads_goes_or_nothing_does)
{
    int done = 0;
    const BoundingGuard guard(model);
    const test::Working before = start(guard, 6);
    for (std::uint32_t q = 0; q < before.table.quads(); q += 17) {
        test::Working now = start(guard, 6);
        const bool isDone = collapseLoopThrough(now.surface, now.table, {q}, nullptr);
        BOOST_TEST(isDone == (now.table.count() < before.table.count()));
        if (!isDone) {
            BOOST_TEST(test::sameSurface(now, before));
            continue;
        }
        ++done;
        BOOST_TEST(!now.table.isQuad(q));
        std::size_t loops = 0; // of which exactly the quads are gone
        for (const QuadLoop& loop : straightLoops(before.table)) {
            const auto isGone = [&](std::uint32_t of) { return !now.table.isQuad(of); };
            loops += loop.quads.size() == before.table.count() - now.table.count() &&
                     std::all_of(loop.quads.begin(), loop.quads.end(), isGone);
        }
        BOOST_TEST(loops == 1U);
        requireGood(now, guard);
    }
    BOOST_TEST(done > 3);
    test::Working none = start(guard, 6);
    BOOST_TEST(!collapseLoopThrough(none.surface, none.table, {}, nullptr));
    BOOST_TEST(test::sameSurface(none, before));
}

BOOST_AUTO_TEST_CASE(an_exchange_brings_a_surface_nearer_with_no_more_quads)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        test::Working before = start(guard, 7);
        const std::size_t quads = isSymmetric ? 40 : 80;
        collapseLoops(before.surface, before.table, quads, AtJoints::anything, 0, nullptr);
        const double sample = areaPerSample(before.surface);
        double last = 1e9;
        for (const int rounds : {0, 3}) {
            test::Working now = before;
            exchangeLoops(now.surface, now.table, quads, rounds, nullptr);
            BOOST_TEST(now.table.count() <= quads);
            requireGood(now, guard);
            const double distance =
                integratedDistance(now.surface, sample) *
                (1 + unfitWeight * double(countUnfit(now.surface, now.table)) / double(now.table.count()));
            BOOST_TEST(distance <= last * 1.001);
            last = distance;
        }
    }
}

BOOST_AUTO_TEST_CASE(rings_are_added_until_a_joint_has_three)
{
    for (const double place : {-6.0, 0.5, 4.0}) {
        Bar bar(place);
        const std::size_t quads = bar.table.count();
        const JointRings rings(bar.surface, bar.table);
        const std::size_t before = rings.count().at(0);
        BOOST_TEST(before < JointRings::wanted);
        BOOST_TEST(!rings.toSplit(bar.surface.wishes().limbs()[0]).empty());
        const std::size_t levels = levelsNear(bar.surface, place, 6);
        addRings(bar.surface, bar.table, nullptr);
        BOOST_TEST(rings.count().at(0) >= JointRings::wanted);
        BOOST_TEST(rings.toSplit(bar.surface.wishes().limbs()[0]).empty());
        BOOST_TEST(levelsNear(bar.surface, place, 6) > levels);
        BOOST_TEST(bar.table.count() > quads);
        BOOST_TEST((bar.table.count() - quads) % 8 == 0U); // each of eight quads
        BOOST_TEST(bar.surface.liveFaces() == 2 * bar.table.count());
        BOOST_TEST(checkCage(bar.surface.mesh(), Bar::inside()).bounding());
        const QuadTable done = bar.table;
        addRings(bar.surface, bar.table, nullptr);
        BOOST_TEST(bar.table.count() == done.count());
        // Their vertices are held between planes across the limb, those nearest to the joint.
        const auto holds = rings.holds();
        BOOST_TEST(holds.size() == 8 * (JointRings::wanted + 1));
        for (std::size_t i = 0; i < holds.size(); ++i) {
            if (i > 0) BOOST_TEST(holds[i - 1].vertex < holds[i].vertex);
            BOOST_TEST((holds[i].normal - Vec3d(1, 0, 0)).length() < 1e-9);
            const Vec3d joint = modelOf(bar.guard).scaled({place, 0, 0});
            BOOST_TEST(std::abs(holds[i].offset - joint[0]) <= 1.5 * holds[i].width);
        }
    }
}

BOOST_AUTO_TEST_CASE(rings_are_kept_as_far_as_they_are_wanted)
{
    using Counts = std::vector<std::size_t>;
    for (std::size_t before = 0; before < 6; ++before) {
        for (std::size_t after = 0; after < 6; ++after) {
            const bool isKept = after >= before || after >= JointRings::wanted;
            BOOST_TEST(JointRings::areKept(Counts{before}, Counts{after}) == isKept);
            BOOST_TEST(JointRings::areKept(Counts{3, before, 0}, Counts{3, after, 0}) == isKept);
        }
    }
    BOOST_TEST(JointRings::areKept({}, {}));
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter_and_every_question_can_cancel)
{
    const BoundingGuard guard(model);
    const std::vector<std::function<void(test::Working&, Interrupter*)>> runs{
        [](test::Working& now, Interrupter* i) {
            collapseLoops(now.surface, now.table, 60, AtJoints::keepRings, 70, i);
        },
        [](test::Working& now, Interrupter* i) { exchangeLoops(now.surface, now.table, 160, 1, i); },
        [](test::Working& now, Interrupter* i) {
            collapseLoopThrough(now.surface, now.table, {1, 5, 9}, i);
        }};
    for (const auto& run : runs) {
        test::Working many = start(guard, 6);
        test::StopAt never(1000000);
        run(many, &never);
        const int asked = test::questions(never, 1000000);
        BOOST_TEST(asked > 3);
        for (int i = 0; i < 4; ++i) {
            test::Working now = start(guard, 6);
            test::StopAt stop(asked * i / 4);
            BOOST_CHECK_THROW(run(now, &stop), Cancelled);
            BOOST_TEST(test::isClosedManifold(now.surface.mesh()));
        }
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        test::Working alone = start(guard, 6);
        run(alone, nullptr);
        BOOST_TEST(test::sameSurface(many, alone));
    }
}

BOOST_AUTO_TEST_SUITE_END()
