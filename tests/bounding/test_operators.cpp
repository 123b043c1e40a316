// The operators that work under a guard: what they make is examined by checkCage, which knows nothing of the guard.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tbb/global_control.h>
#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/triangles/recorded_decimation.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

#include "bounding/support/spacing.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/stop_at.h"
#include "support/surface_models.h"

using namespace vdbcage;
using openvdb::Vec3d;
using test::ball;
using test::quads;
using test::soup;
using test::to;

namespace {

std::vector<Mesh> models()
{
    return {test::sphere({0, 0, 0}, 0.4, 12),
            test::box({-0.3, -0.2, -0.1}, {0.2, 0.2, 0.2}),
            test::torus(0.3, 0.08, 24, 10),
            soup(1, 30, 0.1),
            soup(2, 200, 0.02), // dust
            test::joined(test::box({-0.2, -0.2, -0.2}, {0, 0, 0}), test::box({0, 0, 0}, {0.2, 0.2, 0.2}))};
}

/// The sum over the edges of length times squared angle between the normals.
double bending(const Mesh& mesh)
{
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, Vec3d> normalAt; // of the face left of a directed edge
    for (const auto& t : mesh.triangles) {
        Vec3d normal = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
        normal.normalize();
        for (int i = 0; i < 3; ++i) normalAt[{t[i], t[(i + 1) % 3]}] = normal;
    }
    double sum = 0;
    for (const auto& [edge, normal] : normalAt) {
        const double angle = std::acos(std::clamp(normal.dot(normalAt.at({edge.second, edge.first})), -1.0, 1.0));
        sum += (mesh.points[edge.first] - mesh.points[edge.second]).length() * angle * angle;
    }
    return sum;
}

/// The largest angle between the normals of a quad's four triangles, one at each corner.
double fold(const Mesh& mesh, const openvdb::Vec4I& quad)
{
    std::array<Vec3d, 4> normals;
    for (int i = 0; i < 4; ++i) {
        const Vec3d &p = mesh.points[quad[i]], &next = mesh.points[quad[(i + 1) % 4]],
                    &last = mesh.points[quad[(i + 3) % 4]];
        normals[std::size_t(i)] = (next - p).cross(last - p).unit();
    }
    const double least = std::min(normals[0].dot(normals[2]), normals[1].dot(normals[3]));
    return std::acos(std::clamp(least, -1.0, 1.0)) * 180 / detail::pi;
}

constexpr Effort efforts[] = {Effort::fast, Effort::fair, Effort::best};

} // namespace

BOOST_AUTO_TEST_SUITE(operators)

BOOST_DATA_TEST_CASE(every_cage_bounds_its_model, boost::unit_test::data::make({12, 40, 150}), faces)
{
    int reached = 0;
    for (const Mesh& model : models()) {
        const BoundingGuard guard(model);
        const CageChecker checker(model);
        const Mesh start = ball();
        BOOST_REQUIRE(guard.facesTooNear(start).empty());
        BOOST_REQUIRE(test::pairsTooNear(start, guard) == 0U);
        double tightest = 1e9;
        for (const Effort effort : efforts) {
            const Mesh cage = decimate(start, guard, to(std::size_t(faces), effort));
            const CageCheck check = checker.check(cage);
            BOOST_TEST(check.bounding());
            BOOST_TEST(guard.facesTooNear(cage).empty());
            BOOST_TEST(test::pairsTooNear(cage, guard) == 0U);
            reached += cage.triangles.size() <= std::size_t(faces);
            const Mesh tight = tighten(cage, guard);
            const CageCheck after = checker.check(tight);
            BOOST_TEST(after.bounding());
            BOOST_TEST(after.meanDistance <= check.meanDistance * 1.05);
            BOOST_TEST(tight.triangles.size() == cage.triangles.size());
            BOOST_TEST(test::pairsTooNear(tight, guard) == 0U);
            tightest = std::min(tightest, after.meanDistance);
            const Mesh round = smooth(tight, guard, {5});
            BOOST_TEST(checker.check(round).bounding());
            BOOST_TEST(round.triangles.size() == tight.triangles.size());
            BOOST_TEST(test::pairsTooNear(round, guard) == 0U);
        }
        if (faces > 12) BOOST_TEST(tightest < checker.check(start).meanDistance); // 12 may be looser than hundreds
    }
    BOOST_TEST(reached >= (faces == 12 ? 12 : 16)); // of 18: the guard may lock some, most at few faces
}

BOOST_AUTO_TEST_CASE(a_recorded_decimation_gives_the_same_whatever_was_asked_before)
{
    const Mesh start = ball(24);
    for (const bool isHalved : {false, true}) {
        GuardOptions guarding;
        if (isHalved) guarding.symmetry = SymmetryPlane{0, 0};
        const BoundingGuard guard(test::sphere({0, 0, 0}, 0.4, 12), guarding);
        const Mesh surface = isHalved ? guard.symmetrized(start, 1e-3) : start;
        detail::RecordedDecimation recorded(surface, guard, {}, nullptr);
        for (const std::size_t faces : {100U, 300U, 40U, 300U}) {
            for (const Effort effort : {Effort::fast, Effort::fair}) {
                BOOST_CHECK(test::sameMesh(recorded.to(to(faces, effort), nullptr),
                                           decimate(surface, guard, to(faces, effort))));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_ball_is_wrapped_tightly)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 40);
    const BoundingGuard guard(model);
    const Mesh cage = tighten(decimate(ball(24), guard, to(100, Effort::fair)), guard);
    const CageCheck check = checkCage(cage, model);
    BOOST_TEST(check.bounding());
    // The least possible: 100 equal triangles that touch the ball at their centres are 0.6 % of the diagonal off.
    BOOST_TEST(check.meanDistance < 0.012 * check.diagonal);
    BOOST_TEST(check.minAngleDegrees >= 5.9);
}

BOOST_AUTO_TEST_CASE(thorough_work_pays)
{
    double sum[3] = {0, 0, 0};
    for (const Mesh& model : {test::torus(0.3, 0.08, 24, 10), soup(1, 30, 0.1), test::sphere({0, 0, 0}, 0.4, 12)}) {
        const BoundingGuard guard(model);
        for (int i = 0; i < 3; ++i) {
            TightenOptions tightening;
            tightening.perturbations = i == 0 ? 0 : i == 1 ? 1 : 10; // as the pipeline does
            const Mesh cage = tighten(decimate(ball(24), guard, to(100, efforts[i])), guard, tightening);
            sum[i] += checkCage(cage, model).meanDistance;
        }
    }
    BOOST_TEST(sum[1] < sum[0]);
    BOOST_TEST(sum[2] < sum[1]);
}

BOOST_AUTO_TEST_CASE(what_a_perturbation_gains_in_one_place_is_kept)
{
    // Undone as a whole where it made the whole looser, four perturbations gain next to all that they ever do.
    double few = 0, many = 0;
    for (const Mesh& model : {test::torus(0.3, 0.08, 24, 10), test::torus(0.3, 0.12, 40, 20)}) {
        GuardOptions close;
        close.clearance = 1e-6; // no part of the distance
        const BoundingGuard guard(model, close);
        for (const int faces : {250, 300, 350, 400}) {
            const Mesh cage = decimate(ball(24), guard, to(static_cast<std::size_t>(faces), Effort::fast));
            const auto distance = [&](int perturbations) {
                TightenOptions perturbing;
                perturbing.perturbations = perturbations;
                return checkCage(tighten(cage, guard, perturbing), model).meanDistance;
            };
            few += distance(4);
            many += distance(16);
        }
    }
    BOOST_TEST(many < 0.985 * few);
}

BOOST_AUTO_TEST_CASE(perturbing_only_ever_tightens)
{
    TightenOptions perturbing;
    perturbing.perturbations = 4;
    int tighter = 0;
    for (const Mesh& model : models()) {
        const BoundingGuard guard(model);
        const CageChecker checker(model);
        const Mesh cage = decimate(ball(24), guard, to(60, Effort::fast));
        const CageCheck before = checker.check(tighten(cage, guard)),
                        after = checker.check(tighten(cage, guard, perturbing));
        BOOST_TEST(after.bounding());
        BOOST_TEST(after.meanDistance < 1.02 * before.meanDistance); // the integral drops; the area may, too
        tighter += after.meanDistance < before.meanDistance;
    }
    BOOST_TEST(tighter >= 4); // of 6
}

BOOST_AUTO_TEST_CASE(smoothing_makes_it_rounder)
{
    const Mesh model = test::joined(test::sphere({-0.25, 0, 0}, 0.15, 10), test::sphere({0.25, 0, 0}, 0.15, 10));
    const BoundingGuard guard(model);
    const Mesh tight = tighten(decimate(ball(), guard, to(200, Effort::fast)), guard);
    double last = bending(tight);
    for (const int sweeps : {3, 9}) {
        const double now = bending(smooth(tight, guard, {sweeps}));
        BOOST_TEST(now < 0.95 * last);
        last = now;
    }
    BOOST_CHECK(test::sameMesh(smooth(tight, guard, {0}), tight));
}

BOOST_AUTO_TEST_CASE(quads_bound_and_fold_as_little_as_asked)
{
    constexpr std::size_t faces = 80;
    int reached = 0;
    std::size_t count[3] = {0, 0, 0}, most[3] = {0, 0, 0}; // of quads, of as many as asked and of as many as go
    for (const Mesh& model : models()) {
        GuardOptions close;
        close.clearance = 1e-6;
        const BoundingGuard guard(model, close);
        const CageChecker checker(model);
        const Mesh triangles = decimate(ball(24), guard, to(2 * faces, Effort::fast));
        int i = 0;
        for (const double degrees : {10.0, 30.0, 90.0}) {
            BoundingTriquadOptions all = quads(faces, degrees);
            all.quads = 1;
            most[i] += triquad(triangles, guard, all).quads.size();
            const Mesh cage = triquad(triangles, guard, quads(faces, degrees));
            BOOST_TEST(checker.check(cage).bounding()); // under every split
            reached += faceCount(cage) <= faces;
            for (const auto& quad : cage.quads) BOOST_TEST(fold(cage, quad) <= degrees + 1e-4); // rounded to float
            count[i++] += cage.quads.size();
            for (const Mesh& again : {tighten(cage, guard), smooth(cage, guard, {3})}) {
                BOOST_TEST(checker.check(again).bounding());
                BOOST_TEST(again.quads.size() == cage.quads.size());
            }
        }
    }
    BOOST_TEST(reached >= 16); // of 18, as above
    BOOST_TEST(count[1] > count[0]);
    BOOST_TEST(count[2] > count[1]);
    BOOST_TEST(double(most[1]) > 1.2 * double(most[0]));
    BOOST_TEST(double(most[2]) > 1.05 * double(most[1]));
}

BOOST_AUTO_TEST_CASE(flat_parts_get_flat_faces)
{
    const Vec3d high(0.3, 0.25, 0.2);
    const Mesh model = test::box(-high, high);
    const BoundingGuard guard(model);
    TightenOptions perturbed;
    perturbed.perturbations = 1;
    const Mesh cage = tighten(decimate(ball(24), guard, to(200, Effort::fair)), guard, perturbed);
    // Triangles over a face of the box: how far the heights of their corners go apart.
    std::vector<double> ranges;
    for (const auto& t : cage.triangles) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto isOver = [&](openvdb::Index32 v) {
                const Vec3d& p = cage.points[v];
                const int x = (axis + 1) % 3, y = (axis + 2) % 3;
                return std::abs(p[axis]) > high[axis] && std::abs(p[x]) < high[x] && std::abs(p[y]) < high[y];
            };
            if (!isOver(t[0]) || !isOver(t[1]) || !isOver(t[2])) continue;
            const auto [least, most] =
                std::minmax({std::abs(cage.points[t[0]][axis]), std::abs(cage.points[t[1]][axis]),
                             std::abs(cage.points[t[2]][axis])});
            ranges.push_back(most - least);
        }
    }
    std::sort(ranges.begin(), ranges.end());
    BOOST_REQUIRE(ranges.size() > 50U);
    BOOST_TEST(ranges[ranges.size() / 2] < 1e-7); // 2e-4 where they are only tightened
}

BOOST_AUTO_TEST_CASE(a_quad_whose_corners_across_are_joined_is_split)
{
    // A roof over two lobes that meet in the edge from 1 to 3: the roof's other diagonal, too.
    Mesh cage;
    cage.points = {{0, -1, 0.2}, {-1, 0, 0}, {0, 1, 0.2}, {1, 0, 0}, {0, -1, -1}, {0, 1, -1}};
    cage.triangles = {{3, 0, 4}, {0, 1, 4}, {1, 3, 4}, {2, 3, 5}, {1, 2, 5}, {3, 1, 5}};
    cage.quads = {{0, 3, 2, 1}};
    const BoundingGuard guard(test::sphere({0, -0.5, -0.2}, 0.05, 6));
    TightenOptions none;
    none.sweeps = 0;
    const Mesh result = tighten(cage, guard, none);
    BOOST_TEST(result.quads.empty());
    BOOST_TEST(result.triangles.size() == 8U);
    // With the bottom's edge from 4 to 5 instead it stays.
    cage.triangles = {{3, 0, 4}, {0, 1, 4}, {1, 5, 4}, {5, 3, 4}, {2, 3, 5}, {1, 2, 5}};
    BOOST_TEST(tighten(cage, guard, none).quads.size() == 1U);
}

BOOST_AUTO_TEST_CASE(as_many_quads_as_asked_also_where_it_is_hard)
{
    // Random triangles leave sharp valleys and ridges, where few pairs are convex.
    constexpr std::size_t faces = 120;
    for (const unsigned seed : {1U, 5U, 6U}) {
        const Mesh model = soup(seed, 30, 0.15);
        const BoundingGuard guard(model);
        const CageChecker checker(model);
        const Mesh start = ball(24), fine = decimate(start, guard, to(5 * faces / 2));
        BoundingTriquadOptions options = quads(faces, 90);
        double last = 0;
        for (const double share : {0.0, 0.65, 0.85, 0.9}) {
            options.quads = share;
            const Mesh cage = triquad(fine, guard, options);
            BOOST_TEST(checker.check(cage).bounding());
            BOOST_TEST(faceCount(cage) <= faces);
            BOOST_TEST(test::pairsTooNear(cage, guard) == 0U);
            const double reached = double(cage.quads.size()) / double(faceCount(cage));
            BOOST_TEST(reached >= share);
            BOOST_TEST(reached >= last);
            last = reached;
        }
    }
}

BOOST_AUTO_TEST_CASE(quads_of_flat_parts_are_about_as_tight_as_triangles)
{
    // Where triangles lie close to flat faces, one corner pushed out for a quad is all the distance that there is.
    constexpr std::size_t faces = 160;
    double looser = 0; // times
    for (const int teeth : {2, 3}) {
        const auto lowOf = [&](int k) { return Vec3d(-0.4 + 0.8 * k / teeth, -0.3, -0.05); };
        const Vec3d size(0.4 / teeth, 0.7, 0.1);
        Mesh model = test::box({-0.4, -0.4, -0.05}, {0.4, -0.3, 0.05});
        for (int k = 0; k < teeth; ++k) model = test::joined(model, test::box(lowOf(k), lowOf(k) + size));
        const Mesh start = extractSurface(*test::sample(40, [&](const Vec3d& p) {
            const auto isIn = [&](const Vec3d& low, const Vec3d& high) {
                constexpr double around = 0.05;
                for (int i = 0; i < 3; ++i) {
                    if (p[i] < low[i] - around || p[i] > high[i] + around) return false;
                }
                return true;
            };
            for (int k = 0; k < teeth; ++k) {
                if (isIn(lowOf(k), lowOf(k) + size)) return true;
            }
            return isIn({-0.4, -0.4, -0.05}, {0.4, -0.3, 0.05});
        }));
        const BoundingGuard guard(model);
        const CageChecker checker(model);
        BoundingTriquadOptions options = quads(faces, 90);
        options.quads = 0.875;
        const Mesh cage = triquad(decimate(start, guard, to(3 * faces)), guard, options);
        BOOST_TEST(checker.check(cage).bounding());
        BOOST_TEST(double(cage.quads.size()) >= 0.87 * double(faceCount(cage)));
        BOOST_TEST(faceCount(cage) >= 0.9 * faces);
        const Mesh triangles = tighten(decimate(start, guard, to(faces)), guard);
        looser += 0.5 * checker.check(cage).meanDistance / checker.check(triangles).meanDistance;
    }
    BOOST_TEST(looser < 3); // it is 7 without a limit to what a change may cost
}

BOOST_AUTO_TEST_CASE(most_faces_become_quads_and_stay_tight)
{
    constexpr std::size_t faces = 300;
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 40), start = ball(40);
    const BoundingGuard guard(model);
    const CageChecker checker(model);
    const Mesh triangles = tighten(decimate(start, guard, to(faces)), guard);
    const Mesh cage = triquad(decimate(start, guard, to(2 * faces)), guard, quads(faces, 30));
    BOOST_TEST(faceCount(cage) <= faces);
    BOOST_TEST(faceCount(cage) >= 0.9 * faces);
    BOOST_TEST(cage.quads.size() >= 0.6 * double(faceCount(cage)));
    BOOST_TEST(checker.check(cage).meanDistance < 1.1 * checker.check(triangles).meanDistance);
}

BOOST_AUTO_TEST_CASE(far_from_the_origin_and_at_any_size)
{
    for (const double scale : {1e-90, 1e-6, 1.0, 1e6, 1e90}) {
        for (const double far : {0.0, 1000.0}) {
            const Vec3d move = scale * far * Vec3d(1, -2, 3);
            const Mesh model = test::transformed(soup(3, 30, 0.1), scale, move);
            const BoundingGuard guard(model);
            const Mesh start = test::transformed(ball(), scale, move);
            const Mesh cage = tighten(decimate(start, guard, to(60, Effort::fast)), guard);
            BOOST_TEST(checkCage(cage, model).bounding());
            BOOST_TEST(cage.triangles.size() < start.quads.size());
        }
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = soup(4, 60, 0.1);
    const auto make = [&] {
        const BoundingGuard guard(model);
        const Mesh cage = triquad(decimate(ball(24), guard, to(160, Effort::best)), guard, quads(80, 30));
        return smooth(tighten(cage, guard), guard, {2});
    };
    const Mesh many = make();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(test::sameMesh(many, make()));
}

BOOST_AUTO_TEST_CASE(cancelling_at_any_question_throws)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8), start = ball(12);
    const auto make = [&](Interrupter* interrupter) {
        const BoundingGuard guard(model, {}, interrupter);
        const Mesh cage = decimate(start, guard, to(40, Effort::best), {}, interrupter);
        const Mesh tight = tighten(triquad(cage, guard, quads(20, 30), {}, interrupter), guard, {}, {}, interrupter);
        return smooth(tight, guard, {2}, interrupter);
    };
    test::StopAt never(1000000);
    make(&never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 50);
    for (int i = 0; i < 50; ++i) {
        test::StopAt stop(asked * i / 50);
        BOOST_CHECK_THROW(make(&stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 8), start = ball();
    const BoundingGuard guard(model);
    BOOST_CHECK_THROW(decimate(start, guard, to(3)), InputError);
    BOOST_CHECK_THROW(smooth(start, guard, {101}), InputError);
    TightenOptions options;
    options.sweeps = -1;
    BOOST_CHECK_THROW(tighten(start, guard, options), InputError);
    options = {};
    options.samples = 0;
    BOOST_CHECK_THROW(tighten(start, guard, options), InputError);
    options = {};
    options.perturbations = 101;
    BOOST_CHECK_THROW(tighten(start, guard, options), InputError);
    BOOST_CHECK_THROW(triquad(start, guard, quads(3, 30)), InputError);
    BOOST_CHECK_THROW(triquad(start, guard, quads(30, -1)), InputError);
    BOOST_CHECK_THROW(triquad(start, guard, quads(30, 181)), InputError);
    for (const double share : {-0.01, 1.01, std::nan("")}) {
        BoundingTriquadOptions wrong = quads(30, 30);
        wrong.quads = share;
        BOOST_CHECK_THROW(triquad(start, guard, wrong), InputError);
        wrong = quads(30, 30);
        wrong.quadShape = share;
        BOOST_CHECK_THROW(triquad(start, guard, wrong), InputError);
    }
    BoundingTriquadOptions bad;
    bad.tightening = options;
    BOOST_CHECK_THROW(triquad(start, guard, bad), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
