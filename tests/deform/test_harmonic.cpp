#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <deform/cages.h>
#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/families/harmonic.h>

using namespace vdbcage;
using detail::HarmonicGrid;
using detail::pi;
using detail::UnitCage;
using openvdb::Vec3d;
using test::Kind;
using test::kinds;
using test::longestSide;
using test::pointsInside;
using test::Random;
using test::randomCage;
using test::weighted;

namespace {

/// The rows of points that must be inside.
std::vector<double> rowsOf(const Mesh& mesh, const std::vector<Vec3d>& points, int resolution,
                           Interrupter* interrupter = nullptr)
{
    const UnitCage cage(mesh);
    const HarmonicGrid grid(cage, resolution, interrupter);
    const std::size_t columns = mesh.points.size();
    std::vector<double> rows(points.size() * columns);
    for (std::size_t i = 0; i < points.size(); ++i) {
        BOOST_REQUIRE(grid.row(cage.scaled(points[i]), rows.data() + i * columns));
    }
    return rows;
}

double difference(const std::vector<double>& a, const std::vector<double>& b)
{
    BOOST_REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

double rootMeanSquare(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / double(a.size()));
}

std::vector<Vec3d> pointsInBox(std::uint32_t seed, int count, double half)
{
    Random random(seed);
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i) points.push_back(half * Vec3d(random(-1, 1), random(-1, 1), random(-1, 1)));
    return points;
}

/// The box from -1 to 1, its sides split into four quads.
Mesh splitBox()
{
    Mesh mesh = randomCage(Kind::quads, 0, 0);
    for (Vec3d& p : mesh.points) {
        const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        if (largest > 0) p /= largest;
    }
    return mesh;
}

/// What is harmonic in the box from -1 to 1, and on its side x = 1 the hat function of that side's middle, on the
/// others zero: the series of its separation of variables.
double harmonicHat(const Vec3d& p)
{
    double sum = 0;
    for (int m = 1; m < 80; m += 2) {
        for (int n = 1; n < 80; n += 2) {
            const double rate = 0.5 * pi * std::sqrt(double(m * m + n * n));
            const double decay =
                std::exp(rate * (p.x() - 1)) * (1 - std::exp(-2 * rate * (p.x() + 1))) / (1 - std::exp(-4 * rate));
            const double sign = (m / 2 + n / 2) % 2 ? -1 : 1;
            sum += sign * 64 / (pi * pi * pi * pi * m * m * n * n) * decay * std::sin(0.5 * m * pi * (p.y() + 1)) *
                   std::sin(0.5 * n * pi * (p.z() + 1));
        }
    }
    return sum;
}

/// Two arms, from y = 0 to 3, whose gap is 0.02 wide, on a base from -1 to 0.
Mesh tuningFork()
{
    constexpr double xs[] = {-1, -0.01, 0.01, 1}, ys[] = {-1, 0, 3};
    Mesh mesh;
    const auto at = [](int x, int y, int z) { return static_cast<openvdb::Index32>((x * 3 + y) * 2 + z); };
    for (int i = 0; i < 24; ++i) mesh.points.emplace_back(xs[i / 6], ys[i / 2 % 3], i % 2 - 0.5);
    const auto full = [](int x, int y) { return x >= 0 && x < 3 && y >= 0 && y < 2 && !(x == 1 && y == 1); };
    for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 2; ++y) {
            if (!full(x, y)) continue;
            const auto wall = [&](int x0, int y0, int x1, int y1) { // outside is on the right
                mesh.quads.emplace_back(at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, 1), at(x0, y0, 1));
            };
            mesh.quads.emplace_back(at(x, y, 1), at(x + 1, y, 1), at(x + 1, y + 1, 1), at(x, y + 1, 1));
            mesh.quads.emplace_back(at(x, y, 0), at(x, y + 1, 0), at(x + 1, y + 1, 0), at(x + 1, y, 0));
            if (!full(x, y - 1)) wall(x, y, x + 1, y);
            if (!full(x + 1, y)) wall(x + 1, y, x + 1, y + 1);
            if (!full(x, y + 1)) wall(x + 1, y + 1, x, y + 1);
            if (!full(x - 1, y)) wall(x, y + 1, x, y);
        }
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(harmonic)

BOOST_AUTO_TEST_CASE(rows_are_convex_and_reproduce_points)
{
    const auto check = [](const Mesh& cage, const std::vector<Vec3d>& points, int resolution) {
        const std::vector<double> rows = rowsOf(cage, points, resolution);
        double off = 0, lacking = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            off = std::max(off, (weighted(rows, i, cage.points) - points[i]).length());
            double sum = -1;
            for (std::size_t k = 0; k < cage.points.size(); ++k) sum += rows[i * cage.points.size() + k];
            lacking = std::max(lacking, std::abs(sum));
        }
        BOOST_TEST(off < 1e-10 * longestSide(cage));
        BOOST_TEST(lacking < 1e-14);
        BOOST_TEST(*std::min_element(rows.begin(), rows.end()) >= 0);
    };
    for (const int resolution : {4, 7, 32}) {
        for (const Kind kind : kinds) {
            for (std::uint32_t seed = 0; seed < 4; ++seed) {
                BOOST_TEST_CONTEXT("kind " << int(kind) << " seed " << seed << " resolution " << resolution)
                {
                    const Mesh cage = randomCage(kind, seed);
                    check(cage, pointsInside(cage, seed, 200), resolution);
                }
            }
        }
        BOOST_TEST_CONTEXT("resolution " << resolution)
        {
            // With 7, nodes are on its sides, where rounding decides which are inside.
            check(tuningFork(), {Vec3d(-0.02, 2.8, 0), Vec3d(0.999, 2, 0.4), Vec3d(0, -0.01, 0)}, resolution);
            // From one side of the ring to the other one weights fall below rounding.
            check(test::torus(3, 0.5, 24, 6), {Vec3d(3, 0, 0), Vec3d(-2.8, 0, 0.1), Vec3d(0, 2.9, 0)}, resolution);
        }
    }
}

BOOST_AUTO_TEST_CASE(trilinear_in_a_box)
{
    const Vec3d low(-1);
    // The second one is thinner than a voxel, the third one's upper side is where nodes are.
    for (const Vec3d& high : {Vec3d(1), Vec3d(1, 1, -0.98), Vec3d(1, 1, 0.0625)}) {
        const Mesh cage = test::box(low, high);
        std::vector<Vec3d> points = pointsInBox(1, 300, 1);
        std::vector<double> exact;
        for (Vec3d& x : points) {
            const Vec3d part = 0.5 * (x + Vec3d(1));
            x = low + part * (high - low);
            for (const Vec3d& p : cage.points) {
                double product = 1;
                for (int a = 0; a < 3; ++a) product *= p[a] > low[a] ? part[a] : 1 - part[a];
                exact.push_back(product);
            }
        }
        BOOST_TEST(difference(rowsOf(cage, points, 16), exact) < 1e-11);
    }
}

BOOST_AUTO_TEST_CASE(converges_to_the_series_of_a_box)
{
    const Mesh cage = splitBox();
    std::size_t middle = 0;
    while ((cage.points[middle] - Vec3d(1, 0, 0)).length() > 0) ++middle;
    const std::vector<Vec3d> points = pointsInBox(2, 400, 0.9);
    std::vector<double> exact;
    for (const Vec3d& x : points) exact.push_back(harmonicHat(x));
    const auto error = [&](int resolution) {
        const std::vector<double> rows = rowsOf(cage, points, resolution);
        std::vector<double> found;
        for (std::size_t i = 0; i < points.size(); ++i) found.push_back(rows[i * cage.points.size() + middle]);
        return rootMeanSquare(found, exact);
    };
    BOOST_TEST(error(16) < 0.002);
    BOOST_TEST(error(16) > 3 * error(32));
}

BOOST_AUTO_TEST_CASE(converges_in_cages_of_any_kind)
{
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 3);
        Random random(3);
        std::vector<Vec3d> points; // all are 0.2 or more from the cage
        for (int i = 0; i < 50; ++i) points.push_back(random(0, 0.4) * random.direction());
        const std::vector<double> exact = rowsOf(cage, points, 48);
        const double coarse = rootMeanSquare(rowsOf(cage, points, 8), exact);
        BOOST_TEST(coarse > 2.5 * rootMeanSquare(rowsOf(cage, points, 16), exact));
    }
}

BOOST_AUTO_TEST_CASE(hat_functions_on_the_cage_and_near_it)
{
    const Mesh cage = randomCage(Kind::both, 8);
    const auto& p = cage.points;
    const openvdb::Vec4I q = cage.quads[3];
    const openvdb::Vec3I t = cage.triangles[2];
    const std::vector<Vec3d> on{p[q[1]], 0.25 * p[q[1]] + 0.75 * p[q[2]],
                                0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]),
                                0.5 * p[t[0]] + 0.3 * p[t[1]] + 0.2 * p[t[2]]};
    std::vector<double> hats(on.size() * p.size());
    const auto hat = [&](std::size_t i, openvdb::Index32 point) -> double& { return hats[i * p.size() + point]; };
    hat(0, q[1]) = 1;
    hat(1, q[1]) = 0.25;
    hat(1, q[2]) = 0.75;
    for (int k = 0; k < 4; ++k) hat(2, q[k]) = 0.25;
    hat(3, t[0]) = 0.5;
    hat(3, t[1]) = 0.3;
    hat(3, t[2]) = 0.2;
    BOOST_TEST(difference(rowsOf(cage, on, 16), hats) < 1e-12);
    std::vector<Vec3d> near = on;
    for (Vec3d& x : near) x *= 1 - 1e-8;
    const double off = difference(rowsOf(cage, near, 16), hats);
    BOOST_TEST(off < 1e-6);
    BOOST_TEST(off > 1e-10);
}

BOOST_AUTO_TEST_CASE(continuous_across_voxel_sides)
{
    constexpr int resolution = 9;
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 6);
        const Vec3d corner = boundingBox(cage).min();
        const double voxel = longestSide(cage) / resolution;
        Random random(6);
        std::vector<Vec3d> below, above;
        for (int i = 0; i < 300; ++i) {
            Vec3d x = random(0.4, 0.7) * random.direction(); // many in voxels that the cage meets
            const int axis = i % 3;
            const double low = corner[axis];
            x[axis] = low + (std::round((x[axis] - low) / voxel + 0.5) - 0.5) * voxel;
            if (x.length() > 0.7) continue;
            x[axis] -= 1e-9;
            below.push_back(x);
            x[axis] += 2e-9;
            above.push_back(x);
        }
        BOOST_TEST(difference(rowsOf(cage, below, resolution), rowsOf(cage, above, resolution)) < 1e-7);
    }
}

BOOST_AUTO_TEST_CASE(inside_is_where_the_patches_say)
{
    // A box whose top is twisted: between its top's corners is a saddle, above it at two corners and below at the
    // others.
    Mesh cage = test::box(Vec3d(-1), Vec3d(1));
    for (Vec3d& p : cage.points) {
        if (p.z() > 0) p.z() += 0.5 * p.x() * p.y();
    }
    const UnitCage bound(cage);
    std::vector<double> row(cage.points.size());
    for (const int resolution : {4, 5, 32}) {
        const HarmonicGrid grid(bound, resolution);
        Random random(5);
        for (int i = 0; i < 300; ++i) {
            const double x = random(-1, 1), y = random(-1, 1), z = 1 + 0.5 * x * y + random(-0.2, 0.2);
            const bool inside = z < 1 + 0.5 * x * y;
            BOOST_TEST(grid.row(bound.scaled(Vec3d(x, y, z)), row.data()) == inside);
        }
    }
}

BOOST_AUTO_TEST_CASE(points_outside)
{
    const Mesh torus = test::torus(3, 1, 12, 6);
    const UnitCage cage(torus);
    const HarmonicGrid grid(cage, 24);
    std::vector<double> row(torus.points.size());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3d& x : {Vec3d(0), Vec3d(3, 0, 1.1), Vec3d(4.1, 0, 0), Vec3d(1e300, 0, 0), Vec3d(3, nan, 0)}) {
        BOOST_TEST(!grid.row(cage.scaled(x), row.data()));
    }
    BOOST_TEST(grid.row(cage.scaled(Vec3d(3, 0, 0)), row.data()));
}

BOOST_AUTO_TEST_CASE(does_not_see_across_a_gap)
{
    const Mesh cage = tuningFork();
    for (const int resolution : {8, 16, 33}) { // voxels much wider than the gap
        const std::vector<double> rows = rowsOf(cage, {Vec3d(-0.02, 2.8, 0), Vec3d(-0.3, 2.9, 0.1)}, resolution);
        double across = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Vec3d p = cage.points[i % cage.points.size()];
            if (p.x() > 0 && p.y() > 0) across += rows[i];
        }
        BOOST_TEST(across > 0);
        BOOST_TEST(across < 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(same_bytes_for_any_number_of_threads)
{
    const Mesh cage = randomCage(Kind::both, 14);
    const std::vector<Vec3d> points = pointsInside(cage, 14, 100);
    const std::vector<double> all = rowsOf(cage, points, 24);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST((rowsOf(cage, points, 24) == all));
}

BOOST_AUTO_TEST_CASE(can_be_cancelled)
{
    const Mesh cage = randomCage(Kind::both, 15);
    test::StopAt never(1000000);
    rowsOf(cage, {}, 12, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 14 * 14 + 20); // at each line of nodes and each step of a solution
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(rowsOf(cage, {}, 12, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(bindings_and_weights_are_of_the_grid_asked_for)
{
    const Mesh cage = randomCage(Kind::both, 16);
    const std::vector<Vec3d> points = pointsInside(cage, 16, 40);
    const CoordinateOptions coarse(Coordinates::harmonic, 8), usual(Coordinates::harmonic);
    BOOST_TEST((computeCoordinates(cage, points, coarse) == rowsOf(cage, points, 8)));
    BOOST_TEST((computeCoordinates(cage, points, usual) == rowsOf(cage, points, usual.resolution)));
    BOOST_TEST((computeCoordinates(cage, points, usual) != rowsOf(cage, points, 8)));
    std::vector<Vec3d> posed = cage.points;
    for (Vec3d& p : posed) p *= 1 + 0.2 * p.x();
    const Binding binding(cage, points, coarse);
    BOOST_TEST(binding.options().resolution == 8);
    const Binding read(cage, points, coarse, computeWeights(cage, points, coarse));
    BOOST_TEST((binding.pose(posed) == read.pose(posed)));
    BOOST_CHECK_EXCEPTION(Binding(cage, {Vec3d(0), Vec3d(3, 0, 0)}, coarse), InputError, [](const InputError& error) {
        return std::string(error.what()) == "points: harmonic coordinates are not defined at 1 of 2 points, first at "
                                            "point 1, (3, 0, 0); all must be inside of the cage";
    });
    BOOST_CHECK_THROW(computeWeights(cage, points, {Coordinates::harmonic, 3}), InputError);
}

BOOST_AUTO_TEST_CASE(bad_resolutions)
{
    const UnitCage cage(test::box(Vec3d(-1), Vec3d(1)));
    for (const int resolution : {-1, 3, 257}) {
        BOOST_CHECK_EXCEPTION(HarmonicGrid(cage, resolution), InputError, [&](const InputError& error) {
            return error.what() == "resolution: " + std::to_string(resolution) + " is not allowed; it must be 4 to 256";
        });
    }
}

BOOST_AUTO_TEST_SUITE_END()
