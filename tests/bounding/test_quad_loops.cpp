// Cages of quads in loops, and what they are made by. Loops and surfaces are examined by code that knows nothing of the
// table of quads.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <set>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/quads/quad_shape_term.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

#include "bounding/support/manifold.h"
#include "bounding/support/quad_surface.h"
#include "bounding/support/spacing.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/stop_at.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec3d;
using openvdb::Vec4I;

namespace {

/// The part of the quads that is on a loop that passes no quad twice.
double loopShare(const Mesh& mesh)
{
    std::set<std::size_t> on;
    for (const auto& loop : test::loopsByUnion(mesh)) {
        if (!test::isSimple(loop)) continue;
        for (const auto& pass : loop) on.insert(pass.first);
    }
    return double(on.size()) / double(mesh.quads.size());
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
        const Mesh cage = quadLoops(test::ball(12), guard, test::loops(std::size_t(faces)));
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
    const Mesh cage = quadLoops(start, guard, test::loops(6));
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
        QuadLoopsOptions options = test::loops(150);
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
    const Mesh cage = quadLoops(start, guard, test::loops(80));
    BOOST_TEST(checkCage(cage, model).bounding());
    BOOST_TEST(cage.triangles.empty());
    BOOST_TEST(cage.quads.size() <= 80U);
    std::set<std::array<double, 3>> points;
    for (const Vec3d& p : cage.points) points.insert({p.x(), p.y(), p.z()});
    for (const Vec3d& p : cage.points) BOOST_TEST(points.count({-p.x(), p.y(), p.z()}) == 1U);
}

BOOST_AUTO_TEST_CASE(exchanged_loops_bring_a_surface_nearer)
{
    double before = 0, after = 0;
    for (const Mesh& model : {test::torus(0.3, 0.08, 24, 10), test::box({-0.3, -0.2, -0.1}, {0.2, 0.2, 0.2})}) {
        const BoundingGuard guard(model);
        for (const int exchanges : {0, 4}) {
            QuadLoopsOptions options = test::loops(100);
            options.exchanges = exchanges;
            const Mesh cage = quadLoops(test::ball(14), guard, options);
            BOOST_TEST(cage.quads.size() <= 100U);
            (exchanges == 0 ? before : after) += checkCage(cage, model).meanDistance;
        }
    }
    BOOST_TEST(after < before);
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = test::soup(4, 60, 0.1);
    const BoundingGuard guard(model);
    const auto make = [&] { return quadLoops(test::ball(14), guard, test::loops(60)); };
    const Mesh many = make();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(test::sameMesh(many, make()));
}

BOOST_AUTO_TEST_CASE(cancelling_at_any_question_throws)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8), start = test::ball(7);
    const BoundingGuard guard(model);
    test::StopAt never(1000000);
    quadLoops(start, guard, test::loops(40), {}, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 50);
    for (int i = 0; i < 50; ++i) {
        test::StopAt stop(asked * i / 50);
        BOOST_CHECK_THROW(quadLoops(start, guard, test::loops(40), {}, &stop), Cancelled);
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
    quadLoops(extractSurface(*bar), guard, test::loops(150), {}, &watcher);
    BOOST_TEST(watcher.grows);
    BOOST_TEST(watcher.times > 5);
    BOOST_TEST(watcher.last >= 70);
}

BOOST_AUTO_TEST_CASE(bad_options_and_surfaces_are_refused)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8);
    const BoundingGuard guard(model);
    BOOST_CHECK_THROW(quadLoops(test::ball(), guard, test::loops(5)), InputError);
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
    BOOST_CHECK_THROW(quadLoops(withTriangles, guard, test::loops(40)), InputError);
    Mesh inPairs = test::ball(); // which might be taken for quads
    inPairs.triangles = triangulate(inPairs);
    inPairs.quads.clear();
    BOOST_CHECK_THROW(quadLoops(inPairs, guard, test::loops(40)), InputError);
    Mesh open = test::ball();
    open.quads.pop_back();
    BOOST_CHECK_THROW(quadLoops(open, guard, test::loops(40)), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
