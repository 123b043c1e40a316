// Fits of drawn cages: examined by checkCage, which knows nothing of the guard.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <tbb/global_control.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/symmetry.h>

#include "bounding/support/guarded_surface.h"
#include "support/says.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"

using namespace vdbcage;
using openvdb::Vec3d;

namespace {

BoundingGuard guardFor(const Mesh& model)
{
    return BoundingGuard(model, fitGuardOptions());
}

FitOptions tight(double tightness)
{
    FitOptions options;
    options.tightness = tightness;
    return options;
}

Mesh moved(Mesh mesh, unsigned seed, double size)
{
    std::mt19937 random(seed);
    for (Vec3d& p : mesh.points) p += test::randomVector(random, size);
    return mesh;
}

bool haveSameFaces(const Mesh& a, const Mesh& b)
{
    return a.points.size() == b.points.size() && a.triangles == b.triangles && a.quads == b.quads;
}

/// Returns the number of points that differ in a bit.
std::size_t movedPoints(const Mesh& a, const Mesh& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.points.size(); ++i) count += a.points[i] != b.points[i];
    return count;
}

struct Case {
    const char* name;
    Mesh model, cage;
};

std::vector<Case> cases()
{
    const Mesh ball = test::sphere({0, 0, 0}, 0.5, 10), box = test::box({-0.3, -0.2, -0.4}, {0.3, 0.2, 0.4});
    const Mesh ring = test::torus(0.4, 0.12, 24, 12), coarse = test::torus(0.4, 0.12, 10, 5);
    const Mesh apart =
        test::joined(test::transformed(ball, 0.3, {-0.3, 0, 0}), test::transformed(ball, 0.3, {0.3, 0, 0}));
    return {{"too small", ball, test::sphere({0, 0, 0}, 0.42, 6)},
            {"inside", ball, test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})},
            {"beside", ball, test::sphere({0.3, 0.1, 0}, 0.5, 6)},
            {"a box about a ball", ball, test::box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4})},
            {"a ball about a box", box, test::sphere({0, 0, 0}, 0.3, 6)},
            {"a ring", ring, coarse},
            {"a moved ring", ring, moved(coarse, 3, 0.02)},
            {"two parts", apart, test::sphere({0, 0, 0}, 0.2, 6)},
            {"triangles without order", test::soup(1, 30, 0.1), test::sphere({0, 0, 0}, 0.3, 6)},
            {"points moved a little", ball, moved(test::sphere({0, 0, 0}, 0.5, 7), 1, 0.02)},
            {"points moved far", ball, moved(test::sphere({0, 0, 0}, 0.5, 7), 2, 0.12)}};
}

} // namespace

BOOST_AUTO_TEST_SUITE(fit)

BOOST_AUTO_TEST_CASE(cages_that_cut_come_to_bound)
{
    double tightest = 0; // logarithm of the distance for 1 over that for .5, summed
    for (const auto& [name, model, cage] : cases()) {
        const BoundingGuard guard = guardFor(model);
        const CageChecker checker(model);
        double distances[3];
        int i = 0;
        for (const double tightness : {0.0, 0.5, 1.0}) {
            BOOST_TEST_CONTEXT(name << ", " << tightness)
            {
                const Fit fit = fitCage(cage, guard, tight(tightness));
                BOOST_TEST((fit.obstacle == Fit::Obstacle::none));
                BOOST_TEST(fit.heldFaces.empty());
                BOOST_TEST(haveSameFaces(fit.cage, cage));
                const CageCheck check = checker.check(fit.cage);
                BOOST_TEST(check.bounding());
                BOOST_TEST(guard.facesTooNear(fit.cage).empty());
                distances[i++] = check.meanDistance;
            }
        }
        BOOST_TEST_INFO(name);
        BOOST_TEST(distances[1] <= distances[0]);
        tightest += std::log(distances[2] / distances[1]);
    }
    BOOST_TEST(tightest < 0);
}

BOOST_AUTO_TEST_CASE(a_cage_that_bounds_stays_as_it_is)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 10), cage = test::sphere({0.01, 0, 0}, 0.6, 7);
    BOOST_REQUIRE(checkCage(cage, model).bounding());
    BOOST_TEST(movedPoints(fitCage(cage, guardFor(model), tight(0)).cage, cage) == 0U);
    BOOST_TEST(movedPoints(fitCage(cage, guardFor(model), tight(1)).cage, cage) > 0U);
}

BOOST_AUTO_TEST_CASE(no_part_of_the_model_is_too_small_to_be_inside)
{
    // A speck just outside of the cage, in one cell of the samples with a point of the model inside.
    Mesh model = test::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    const Mesh speck = test::transformed(model, 1e-4, {0.5 + 2e-3, 0.5, 0.5});
    model = test::joined(model, speck);
    const Mesh cage = test::box({-0.501, -0.501, -0.501}, {0.501, 0.501, 0.501});
    BOOST_REQUIRE(guardFor(model).facesTooNear(cage).empty());
    BOOST_REQUIRE(!checkCage(cage, model).bounding());
    BOOST_TEST(checkCage(fitCage(cage, guardFor(model), tight(0)).cage, model).bounding());
}

BOOST_AUTO_TEST_CASE(only_the_surroundings_of_a_cut_move)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 16);
    Mesh cage = test::sphere({0, 0, 0}, 0.56, 12);
    const std::size_t dent = cage.points.size() / 2;
    cage.points[dent] *= 0.8;
    const Fit fit = fitCage(cage, guardFor(model), tight(0));
    BOOST_TEST(checkCage(fit.cage, model).bounding());
    std::set<std::size_t> near{dent};
    for (int ring = 0; ring < 2; ++ring) {
        std::set<std::size_t> wider = near;
        const auto widen = [&](const auto& face) {
            bool meets = false;
            for (int i = 0; i < face.size; ++i) meets = meets || near.count(face[i]) > 0;
            for (int i = 0; meets && i < face.size; ++i) wider.insert(face[i]);
        };
        for (const auto& t : cage.triangles) widen(t);
        for (const auto& q : cage.quads) widen(q);
        near = wider;
    }
    BOOST_TEST(cage.points[dent] != fit.cage.points[dent]);
    for (std::size_t i = 0; i < cage.points.size(); ++i) {
        if (near.count(i) == 0) BOOST_TEST((cage.points[i] == fit.cage.points[i]), i);
    }
}

BOOST_AUTO_TEST_CASE(as_tight_as_tighten)
{
    const Mesh model = test::torus(0.4, 0.12, 24, 12), cage = test::torus(0.4, 0.16, 12, 6);
    const BoundingGuard guard = guardFor(model);
    BOOST_REQUIRE(checkCage(cage, model).bounding());
    const double tightened = checkCage(tighten(cage, guard), model).meanDistance;
    BOOST_TEST(checkCage(fitCage(cage, guard, tight(1)).cage, model).meanDistance <= 1.1 * tightened);
}

BOOST_AUTO_TEST_CASE(kept_points_keep_their_bits)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 10);
    Mesh cage = test::sphere({0, 0, 0}, 0.45, 7);
    cage.points[0] = Vec3d(0.03, 0, 0.6); // the pole
    const BoundingGuard guard = guardFor(model);
    FitOptions options = tight(1);
    options.keptPoints = {0};
    const Fit fit = fitCage(cage, guard, options);
    BOOST_TEST(checkCage(fit.cage, model).bounding());
    BOOST_TEST((fit.cage.points[0] == cage.points[0]));
    BOOST_TEST(movedPoints(fit.cage, cage) > cage.points.size() / 2);

    // The point 20 is inside of the model: the faces around it cannot bound.
    options.keptPoints = {20};
    const Fit held = fitCage(cage, guard, options);
    BOOST_TEST((held.obstacle == Fit::Obstacle::model));
    BOOST_TEST(haveSameFaces(held.cage, cage));
    BOOST_TEST((held.cage.points[20] == cage.points[20]));
    BOOST_REQUIRE(!held.heldFaces.empty());
    BOOST_TEST((held.holdingPoints == std::vector<std::size_t>{20}));
    for (const std::size_t face : held.heldFaces) {
        const std::size_t triangles = cage.triangles.size();
        const bool isAround =
            face < triangles ? test::hasCorner(cage.triangles[face], 20) : [&](const openvdb::Vec4I& q) {
                return q[0] == 20 || q[1] == 20 || q[2] == 20 || q[3] == 20;
            }(cage.quads[face - triangles]);
        BOOST_TEST(isAround, face);
    }
}

BOOST_AUTO_TEST_CASE(points_on_rails_move_along_their_axes)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 10);
    const Mesh cage = test::sphere({0, 0, 0}, 0.45, 8);
    const BoundingGuard guard = guardFor(model);
    FitOptions options = tight(1);
    for (std::size_t i = 0; i < cage.points.size(); ++i) {
        if (std::abs(cage.points[i][0]) < 1e-12) options.rails.push_back({i, {false, true, true}});
    }
    const auto aside = std::find_if(cage.points.begin(), cage.points.end(), [](const Vec3d& p) { return p[0] > 0.3; });
    options.rails.push_back({static_cast<std::size_t>(aside - cage.points.begin()), {true, false, false}});
    BOOST_REQUIRE(options.rails.size() > 3U);
    const Fit fit = fitCage(cage, guard, options);
    BOOST_TEST(checkCage(fit.cage, model).bounding());
    std::size_t slid = 0;
    for (const FitOptions::Rail& rail : options.rails) {
        for (int i = 0; i < 3; ++i) {
            const bool moved = fit.cage.points[rail.point][i] != cage.points[rail.point][i];
            slid += moved;
            if (moved) BOOST_TEST(rail.mayMove[static_cast<std::size_t>(i)]);
        }
    }
    BOOST_TEST(slid > options.rails.size());
}

BOOST_AUTO_TEST_CASE(no_point_goes_farther_than_it_may)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 10);
    const Mesh cage = moved(test::sphere({0, 0, 0}, 0.6, 7), 2, 0.08);
    const BoundingGuard guard = guardFor(model);
    double farthest = 0;
    for (const double most : {1.0, 0.15, 0.1}) {
        FitOptions options = tight(1);
        options.mostWay = most;
        const Fit fit = fitCage(cage, guard, options);
        BOOST_TEST(checkCage(fit.cage, model).bounding());
        double way = 0;
        for (std::size_t i = 0; i < cage.points.size(); ++i)
            way = std::max(way, (fit.cage.points[i] - cage.points[i]).length());
        BOOST_TEST(way <= most);
        farthest = std::max(farthest, way);
    }
    BOOST_TEST(farthest > 0.15);
    FitOptions still = tight(1);
    still.mostWay = 0.001;
    const Fit held = fitCage(cage, guard, still);
    BOOST_TEST((held.obstacle != Fit::Obstacle::none));
    for (std::size_t i = 0; i < cage.points.size(); ++i)
        BOOST_TEST((held.cage.points[i] - cage.points[i]).length() <= 0.001);
    still.mostWay = -1;
    BOOST_CHECK_EXCEPTION(fitCage(cage, guard, still), InputError, test::says("most way"));
}

BOOST_AUTO_TEST_CASE(symmetric_cages_stay_symmetric)
{
    // A body with a limb on each side, of which one is longer.
    Mesh model = test::sphere({0, 0, 0}, 0.5, 16);
    for (Vec3d& p : model.points) p[0] *= std::abs(p[0]) > 0.35 ? (p[0] > 0 ? 2.1 : 2) : 1;
    GuardOptions guardOptions = fitGuardOptions();
    guardOptions.symmetry = SymmetryPlane{0, 0.0};
    const BoundingGuard guard(model, guardOptions);
    const Mesh even = test::sphere({0, 0, 0}, 0.45, 8);
    for (const double tightness : {0.0, 0.5, 1.0}) {
        Mesh cage = moved(even, 5, 0.002); // nearly symmetric
        FitOptions options = tight(tightness);
        options.rails = {{3, {true, true, false}}};
        const Fit fit = fitCage(cage, guard, options);
        BOOST_TEST(haveSameFaces(fit.cage, cage));
        BOOST_TEST(checkCage(fit.cage, model).bounding());
        std::size_t onPlane = 0;
        for (std::size_t i = 0; i < even.points.size(); ++i) {
            const Vec3d& p = fit.cage.points[i];
            const Vec3d image(-p[0], p[1], p[2]);
            BOOST_TEST((std::find(fit.cage.points.begin(), fit.cage.points.end(), image) != fit.cage.points.end()));
            onPlane += p[0] == 0;
        }
        BOOST_TEST(onPlane == 16U);
    }
    Mesh lopsided = even;
    const auto side = std::find_if(even.points.begin(), even.points.end(), [](const Vec3d& p) { return p[0] > 0.3; });
    lopsided.points[static_cast<std::size_t>(side - even.points.begin())] *= 1.2;
    BOOST_CHECK_EXCEPTION(fitCage(lopsided, guard), InputError, test::says("it is not symmetric: point "));
    BOOST_CHECK_EXCEPTION(fitCage(test::box({-1, -1, -1}, {1, 1, 1}), guard), InputError,
                          test::says("lies across the plane of symmetry, where it needs edges"));
}

BOOST_AUTO_TEST_CASE(cages_of_other_units_are_placed)
{
    Mesh model = test::sphere({0, 0, 0}, 0.5, 8);
    for (Vec3d& p : model.points) p = Vec3d(p[0], 0.3 * p[1], 0.5 * p[2] + (p[0] > 0 ? 2 * p[0] * p[0] : 0));
    const BoundingGuard guard = guardFor(model);
    Mesh cage = model;
    for (Vec3d& p : cage.points) p = 250 * p + Vec3d(3000, 20, -7);
    const auto difference = [&](const Mesh& placed) {
        double most = 0;
        for (std::size_t i = 0; i < placed.points.size(); ++i)
            most = std::max(most, (placed.points[i] - model.points[i]).length());
        return most;
    };
    BOOST_TEST(difference(placeCage(cage, guard)) < 1e-6);
    for (Vec3d& p : cage.points) p = Vec3d(-p[1], p[2], -p[0]);
    BOOST_TEST(difference(placeCage(cage, guard)) > 0.3);
    const Mesh turned = placeCage(cage, guard, PlaceTurns::quarters);
    BOOST_TEST(haveSameFaces(turned, model));
    BOOST_TEST(difference(turned) < 1e-6);
    BOOST_TEST(checkCage(fitCage(turned, guard).cage, model).bounding());
    BOOST_CHECK_THROW(placeCage(Mesh(), guard), InputError);
}

BOOST_AUTO_TEST_CASE(what_keeps_a_cage_from_bounding_is_told)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.2, 8);
    const BoundingGuard guard = guardFor(model);
    FitOptions options;
    options.keptPoints = {0, 1, 2, 3, 4, 5, 6, 7};
    Mesh crossing = test::box({-1, -1, -1}, {1, 1, 1});
    crossing.points[0] = Vec3d(1.2, 0, 0); // through the side
    const Fit crossed = fitCage(crossing, guard, options);
    BOOST_TEST((crossed.obstacle == Fit::Obstacle::itself));
    BOOST_TEST(!crossed.heldFaces.empty());
    Mesh concave = test::box({-1, -1, -1}, {1, 1, 1});
    concave.points[7] = Vec3d(-0.2, -0.2, 1);
    const Fit bent = fitCage(concave, guard, options);
    BOOST_TEST((bent.obstacle == Fit::Obstacle::quads));
    BOOST_TEST(std::count(bent.heldFaces.begin(), bent.heldFaces.end(), 5U) == 1); // the top
    for (const Fit& fit : {crossed, bent}) BOOST_TEST(haveSameFaces(fit.cage, crossing));
    BOOST_TEST(movedPoints(crossed.cage, crossing) == 0U);
    BOOST_TEST(movedPoints(bent.cage, concave) == 0U);
}

BOOST_AUTO_TEST_CASE(points_at_one_place_move_together)
{
    // The box of a modelling program: four points a face.
    const Mesh box = test::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
    Mesh cage;
    for (const auto& q : box.quads) {
        const auto first = static_cast<openvdb::Index32>(cage.points.size());
        for (int i = 0; i < 4; ++i) cage.points.push_back(box.points[q[i]]);
        cage.quads.emplace_back(first, first + 1, first + 2, first + 3);
    }
    const Mesh model = test::sphere({0, 0, 0}, 0.3, 8);
    const Fit fit = fitCage(cage, guardFor(model), tight(1));
    BOOST_TEST(haveSameFaces(fit.cage, cage));
    std::set<Vec3d> places(fit.cage.points.begin(), fit.cage.points.end());
    BOOST_TEST(places.size() == 8U);
    Mesh joined = box;
    for (std::size_t i = 0; i < cage.quads.size(); ++i) {
        for (int k = 0; k < 4; ++k) joined.points[box.quads[i][k]] = fit.cage.points[cage.quads[i][k]];
    }
    BOOST_TEST(checkCage(joined, model).bounding());
}

BOOST_AUTO_TEST_CASE(points_drawn_onto_each_other_come_apart)
{
    // As Blender's Shrinkwrap leaves them: two neighbours at one place, and two points that no face joins.
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 10);
    Mesh cage = test::sphere({0, 0, 0}, 0.52, 7);
    cage.points[20] = cage.points[21];
    cage.points[40] = cage.points[42];
    const Fit fit = fitCage(cage, guardFor(model));
    BOOST_TEST(haveSameFaces(fit.cage, cage));
    BOOST_TEST(checkCage(fit.cage, model).bounding());
    BOOST_TEST((fit.cage.points[20] != fit.cage.points[21]));
    BOOST_TEST((fit.cage.points[40] != fit.cage.points[42]));
}

BOOST_AUTO_TEST_CASE(a_concave_quad_becomes_one_that_bounds_under_both_diagonals)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.3, 8);
    Mesh box = test::box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4});
    box.points[7] = Vec3d(0.05, 0.05, 0.4); // the quad of the top is concave there
    // As a reader gives it: two triangles, and their other splits.
    Mesh cage = box;
    const openvdb::Vec4I top = cage.quads.back();
    cage.quads.pop_back();
    int at = 0;
    while (top[at] != 7) ++at;
    const auto corner = [&](int i) { return top[(at + i) % 4]; };
    cage.triangles = {{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}};
    cage.alternatives = {{corner(1), corner(2), corner(3)}, {corner(0), corner(1), corner(3)}};
    const Fit fit = fitCage(cage, guardFor(model));
    BOOST_TEST(haveSameFaces(fit.cage, cage));
    box.points = fit.cage.points;
    BOOST_TEST(checkCage(box, model).bounding());
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = test::soup(1, 30, 0.1), cage = moved(test::sphere({0, 0, 0}, 0.3, 6), 5, 0.02);
    const BoundingGuard guard = guardFor(model);
    std::vector<Mesh> results;
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(fitCage(cage, guard).cage);
    }
    BOOST_TEST(test::sameMesh(results[0], results[1]));
    BOOST_TEST(test::sameMesh(results[0], results[2]));
}

BOOST_AUTO_TEST_CASE(cancelling_at_any_question)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 8), cage = moved(test::sphere({0, 0, 0}, 0.5, 5), 2, 0.12);
    const BoundingGuard guard = guardFor(model);
    constexpr int start = 1 << 30;
    test::StopAt never(start);
    fitCage(cage, guard, {}, &never);
    const int all = test::questions(never, start);
    BOOST_TEST(all > 20);
    for (int k = 0; k < all; k += std::max(1, all / 40)) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(fitCage(cage, guard, {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(cages_that_are_none_are_refused)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.5, 8), cage = test::sphere({0, 0, 0}, 0.45, 6);
    const BoundingGuard guard = guardFor(model);
    Mesh open = cage;
    open.triangles.pop_back();
    BOOST_CHECK_EXCEPTION(fitCage(open, guard), InputError,
                          test::says("cage: it is not a closed, oriented 2-manifold (3 boundary edges"));
    Mesh turned = cage;
    for (auto& t : turned.triangles) std::swap(t[0], t[1]);
    for (auto& q : turned.quads) std::swap(q[1], q[3]);
    BOOST_CHECK_EXCEPTION(fitCage(turned, guard), InputError, test::says("cage: it faces inward"));
    BOOST_CHECK_EXCEPTION(fitCage(cage, guard, tight(1.5)), InputError, test::says("tightness: 1.5 is not allowed"));
    FitOptions options;
    options.keptPoints = {cage.points.size()};
    BOOST_CHECK_EXCEPTION(fitCage(cage, guard, options), InputError, test::says("kept points: 62 is not allowed"));
}

BOOST_AUTO_TEST_SUITE_END()
