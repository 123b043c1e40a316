#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <deform/cages.h>
#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/families/biharmonic.h>
#include <vdbcage/deform/weights_io.h>

using namespace vdbcage;
using detail::BiharmonicCage;
using detail::BiharmonicPart;
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

using Triangle = std::array<Vec3d, 3>;
using Rows = std::vector<std::vector<double>>;

/// The rows of points that must be inside, `together` at a time. `cage` has triangles only.
Rows rowsOf(const UnitCage& bound, const BiharmonicCage& cage, const std::vector<Vec3d>& points,
            std::size_t together = detail::packetSize)
{
    Rows rows(points.size(), std::vector<double>(cage.columns()));
    std::vector<std::array<double, detail::packetSize>> packet(cage.columns());
    for (std::size_t first = 0; first < points.size(); first += together) {
        const std::size_t count = std::min(together, points.size() - first);
        std::vector<Vec3d> at;
        for (std::size_t i = 0; i < count; ++i) at.push_back(bound.scaled(points[first + i]));
        auto* const to = reinterpret_cast<detail::Packet*>(packet.data());
        BOOST_REQUIRE(cage.rows(at.data(), count, to) == 0);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < packet.size(); ++k) rows[first + i][k] = packet[k][i];
        }
    }
    return rows;
}

Rows rowsOf(const Mesh& mesh, const std::vector<Vec3d>& points, std::size_t together = detail::packetSize)
{
    const UnitCage bound(test::cageFor(Coordinates::biharmonic, mesh));
    return rowsOf(bound, BiharmonicCage(bound), points, together);
}

double difference(const Rows& a, const Rows& b)
{
    BOOST_REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < a[i].size(); ++k) most = std::max(most, std::abs(a[i][k] - b[i][k]));
    }
    return most;
}

/// A function with its gradient.
struct Function {
    double (*value)(const Vec3d&);
    Vec3d (*gradient)(const Vec3d&);
};

/// What the rows make of the function's data on the cage, less the function: the largest.
double error(const Mesh& mesh, const std::vector<Vec3d>& points, const Rows& rows, const Function& function)
{
    std::vector<double> data;
    for (const Vec3d& p : mesh.points) data.push_back(function.value(p));
    for (const openvdb::Vec3I& t : detail::triangulateByShorterDiagonal(mesh)) {
        const Vec3d a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
        // The weight is of a length, in units of the cage's size.
        data.push_back(function.gradient((a + b + c) / 3).dot((b - a).cross(c - a)) / longestSide(mesh));
    }
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        double sum = -function.value(points[i]);
        for (std::size_t k = 0; k < data.size(); ++k) sum += rows[i][k] * data[k];
        most = std::max(most, std::abs(sum));
    }
    return most;
}

constexpr Function affine[] = {
    {[](const Vec3d&) { return 1.0; }, [](const Vec3d&) { return Vec3d(0); }},
    {[](const Vec3d& p) { return p.x(); }, [](const Vec3d&) { return Vec3d(1, 0, 0); }},
    {[](const Vec3d& p) { return 3 - 2 * p.y() + p.z(); }, [](const Vec3d&) { return Vec3d(0, -2, 1); }},
};

constexpr Function biharmonics[] = {
    {[](const Vec3d& p) { return p.lengthSqr(); }, [](const Vec3d& p) { return 2 * p; }},
    {[](const Vec3d& p) { return p.x() * p.lengthSqr(); },
     [](const Vec3d& p) { return 2 * p.x() * p + Vec3d(p.lengthSqr(), 0, 0); }},
    {[](const Vec3d& p) { return p.x() * p.x() * p.x() - 3 * p.x() * p.y() * p.y(); }, // harmonic
     [](const Vec3d& p) { return Vec3d(3 * p.x() * p.x() - 3 * p.y() * p.y(), -6 * p.x() * p.y(), 0); }},
};

// --- The defining integrals, by a rule of degree 5 on pieces that are quartered until two levels agree.

using Numbers = std::array<double, 8>; // of each corner: values, Laplacians; then the two slopes

Numbers numbersOf(const BiharmonicPart& part)
{
    return {part.values[0],     part.values[1],     part.values[2], part.laplacians[0],
            part.laplacians[1], part.laplacians[2], part.slope,     part.laplacianSlope};
}

Numbers rule(const Triangle& c, const Triangle& hats) // `hats`: of each corner of the piece, those of the triangle
{
    const double root = std::sqrt(15.0), a = (6 - root) / 21, b = (6 + root) / 21;
    const double weightA = (155 - root) / 1200, weightB = (155 + root) / 1200;
    const double samples[7][4] = {{1. / 3, 1. / 3, 1. / 3, 9. / 40}, {a, a, 1 - 2 * a, weightA},
                                  {a, 1 - 2 * a, a, weightA},        {1 - 2 * a, a, a, weightA},
                                  {b, b, 1 - 2 * b, weightB},        {b, 1 - 2 * b, b, weightB},
                                  {1 - 2 * b, b, b, weightB}};
    const Vec3d normal = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    Numbers sum{};
    for (const auto& s : samples) {
        const Vec3d p = s[0] * c[0] + s[1] * c[1] + s[2] * c[2], hat = s[0] * hats[0] + s[1] * hats[1] + s[2] * hats[2];
        const double r = p.length(), height = c[0].dot(normal);
        for (int i = 0; i < 3; ++i) {
            sum[std::size_t(i)] += s[3] * hat[i] * height / (4 * pi * r * r * r);
            sum[std::size_t(3 + i)] -= s[3] * hat[i] * height / (8 * pi * r);
        }
        sum[6] += s[3] * normal.length() / (4 * pi * r);
        sum[7] += s[3] * normal.length() * r / (8 * pi);
    }
    return sum;
}

Numbers integral(const Triangle& c, const Triangle& hats = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)},
                 int depth = 0)
{
    const auto middles = [](const Triangle& t) {
        return Triangle{0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]), 0.5 * (t[0] + t[1])};
    };
    const Triangle m = middles(c), mh = middles(hats);
    const std::array<Triangle, 4> quarters{{{c[0], m[2], m[1]}, {m[2], c[1], m[0]}, {m[1], m[0], c[2]}, m}};
    const std::array<Triangle, 4> hatsOf{
        {{hats[0], mh[2], mh[1]}, {mh[2], hats[1], mh[0]}, {mh[1], mh[0], hats[2]}, mh}};
    const Numbers coarse = rule(c, hats);
    Numbers fine{};
    for (std::size_t q = 0; q < 4; ++q) {
        const Numbers part = rule(quarters[q], hatsOf[q]);
        for (std::size_t k = 0; k < 8; ++k) fine[k] += part[k];
    }
    double off = 0;
    for (std::size_t k = 0; k < 8; ++k) off = std::max(off, std::abs(fine[k] - coarse[k]));
    if ((off < 1e-12 && depth > 1) || depth == 40) return fine;
    fine = {};
    for (std::size_t q = 0; q < 4; ++q) {
        const Numbers part = integral(quarters[q], hatsOf[q], depth + 1);
        for (std::size_t k = 0; k < 8; ++k) fine[k] += part[k];
    }
    return fine;
}

/// How far the part is off of what is to be integrated. The slopes are over twice the area.
double offIntegral(const Triangle& corners, double& largest)
{
    Numbers expected = integral(corners);
    const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
    expected[6] /= area;
    expected[7] /= area;
    const Numbers numbers = numbersOf(detail::biharmonicPart(corners, false));
    double off = 0;
    for (std::size_t k = 0; k < 8; ++k) {
        off = std::max(off, std::abs(numbers[k] - expected[k]) / (k < 6 ? 1 : std::max(1.0, expected[k])));
        largest = std::max(largest, std::abs(expected[k]));
    }
    return off;
}

/// The box from -1 to 1, each side split into n x n quads.
Mesh splitBox(int fineness)
{
    Mesh mesh = randomCage(Kind::quads, 0, 0, fineness);
    for (int i = 0, n = 2 * fineness + 1; i < n * n * n; ++i) {
        mesh.points[std::size_t(i)] = Vec3d(i / n / n, i / n % n, i % n) / fineness - Vec3d(1);
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(biharmonic)

BOOST_AUTO_TEST_CASE(potentials_are_the_defining_integrals)
{
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const auto point = [&] { return Vec3d(random(-1, 1), random(-1, 1), random(-1, 1)); };
        const Triangle t{point(), point(), point()};
        const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]).unit();
        const double u = random(0.2, 0.8), v = random(0.1, 0.9) * (1 - u);
        const Vec3d inner = u * t[0] + v * t[1] + (1 - u - v) * t[2], side = u * t[0] + (1 - u) * t[1];
        const double near = seed % 2 ? 1e-2 : -1e-4;
        const std::pair<const char*, Vec3d> places[] = {{"anywhere", point()},
                                                        {"far away", 30 * point()},
                                                        {"near the face", inner + near * normal},
                                                        {"near an edge", side + near * point()},
                                                        {"near a corner", t[0] + near * point()},
                                                        {"in the plane", 3 * t[0] - t[1] - t[2]}};
        for (const auto& [name, x] : places) {
            double largest = 0;
            const double off = offIntegral({t[0] - x, t[1] - x, t[2] - x}, largest);
            BOOST_TEST_CONTEXT(name << " seed " << seed)
            {
                BOOST_TEST(off < 1e-10);
                BOOST_TEST(largest > 1e-6);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(potentials_of_narrow_triangles)
{
    // From both sides of where closed forms give way to quadrature: the numbers are continuous there.
    const auto at = [](double width) {
        return numbersOf(detail::biharmonicPart(
            {Vec3d(-0.4, 0.3, 0.2), Vec3d(0.5, 0.2, 0.1), Vec3d(0.05, 0.25, 0.15) + width * Vec3d(0.2, 0.7, -0.3)},
            false));
    };
    for (const double width : {0.0, 1e-12, 1e-9, 1e-7}) {
        const double wide = 3e-7; // no number changes by more than the width does
        const Numbers narrow = at(width), wider = at(wide);
        for (std::size_t k = 0; k < 8; ++k) BOOST_TEST(std::abs(narrow[k] - wider[k]) < wide);
        BOOST_TEST(narrow[6] > 0.01); // of a length, whatever the area
    }
    const Vec3d same(0.1, 0.2, 0.3);
    for (const double number : numbersOf(detail::biharmonicPart({same, same, same}, false))) {
        BOOST_TEST(std::isfinite(number));
    }
    for (const double number : numbersOf(detail::biharmonicPart({Vec3d(0), Vec3d(0), Vec3d(0)}, false))) {
        BOOST_TEST(std::isfinite(number));
    }
}

BOOST_AUTO_TEST_CASE(affine_functions_are_exact)
{
    for (const Kind kind : kinds) {
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Mesh cage = randomCage(kind, seed);
            const std::vector<Vec3d> points = pointsInside(test::cageFor(Coordinates::biharmonic, cage), seed, 50);
            const Rows rows = rowsOf(cage, points);
            for (const Function& function : affine) BOOST_TEST(error(cage, points, rows, function) < 1e-12);
        }
    }
}

BOOST_AUTO_TEST_CASE(handles_at_rest_and_similarities)
{
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 7);
        const std::vector<Vec3d> points = pointsInside(test::cageFor(Coordinates::biharmonic, cage), 7, 50);
        const std::vector<double> coordinates = computeCoordinates(cage, points, Coordinates::biharmonic);
        Random random(7);
        openvdb::Mat3d turn;
        turn.setToRotation(random.direction(), 2);
        const auto map = [&](const Vec3d& p) { return 3.0 * (turn * p) + Vec3d(5, -2, 1); };
        std::vector<Vec3d> posed;
        for (const Vec3d& p : cage.points) posed.push_back(map(p));
        const std::vector<Vec3d> rest = cageHandles(cage, cage.points, Coordinates::biharmonic),
                                 handles = cageHandles(cage, posed, Coordinates::biharmonic);
        BOOST_REQUIRE(handles.size() == cage.points.size() + cage.triangles.size() + 2 * cage.quads.size());
        BOOST_REQUIRE(coordinates.size() == points.size() * handles.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            BOOST_TEST((weighted(coordinates, i, rest) - points[i]).length() < 1e-11);
            BOOST_TEST((weighted(coordinates, i, handles) - map(points[i])).length() < 1e-10);
            double sum = -1;
            for (std::size_t k = 0; k < cage.points.size(); ++k) sum += coordinates[i * handles.size() + k];
            BOOST_TEST(std::abs(sum) < 1e-13);
        }
        // The library's rows are these; quads are halved at rest.
        const Rows rows = rowsOf(cage, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (std::size_t k = 0; k < handles.size(); ++k) {
                BOOST_REQUIRE(coordinates[i * handles.size() + k] == rows[i][k]);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(biharmonic_functions_are_approached)
{
    // Halving the triangles quarters the errors: order 2, see the ratios.
    const auto check = [](const char* name, const auto& cageOf) {
        for (std::size_t f = 0; f < 3; ++f) {
            std::vector<double> errors;
            for (const int fineness : {1, 2}) {
                const Mesh cage = cageOf(fineness);
                std::vector<Vec3d> points;
                Random random(3);
                for (int i = 0; i < 50; ++i) points.push_back(random(0, 0.7) * random.direction());
                errors.push_back(error(cage, points, rowsOf(cage, points), biharmonics[f]));
            }
            BOOST_TEST_MESSAGE(name << ": function " << f << " is off by " << errors[0] << ", " << errors[1]);
            BOOST_TEST_CONTEXT(name << " function " << f)
            {
                BOOST_TEST(errors[0] < 0.4);
                BOOST_TEST(errors[0] / errors[1] > 3);
            }
        }
    };
    check("box", [](int fineness) { return splitBox(fineness); });
    check("ball", [](int fineness) { return randomCage(Kind::triangles, 0, 0, fineness); });
}

BOOST_AUTO_TEST_CASE(weights_are_tame)
{
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const Mesh cage = randomCage(Kind::both, seed, 0.3);
        const std::vector<Vec3d> points = pointsInside(test::cageFor(Coordinates::biharmonic, cage), seed, 50);
        double most = 0;
        for (const std::vector<double>& row : rowsOf(cage, points)) {
            double sum = 0;
            for (std::size_t k = 0; k < cage.points.size(); ++k) sum += std::abs(row[k]);
            most = std::max(most, sum);
        }
        BOOST_TEST(most < 3);
    }
}

BOOST_AUTO_TEST_CASE(bends_keep_to_the_cage)
{
    // Where the pose hardly shears, points on the cage stay on it better than by Green coordinates.
    const Mesh cage = randomCage(Kind::triangles, 2, 0.1);
    std::vector<Vec3d> posed = cage.points, middles, targets;
    for (Vec3d& p : posed) {
        const double angle = 0.5 * p.x(), radius = 2 - p.z();
        p = Vec3d(radius * std::sin(angle), p.y(), 2 - radius * std::cos(angle));
    }
    for (const openvdb::Vec3I& t : cage.triangles) {
        middles.push_back((cage.points[t[0]] + cage.points[t[1]] + cage.points[t[2]]) / 3);
        targets.push_back((posed[t[0]] + posed[t[1]] + posed[t[2]]) / 3);
    }
    const auto off = [&](Coordinates family) {
        const std::vector<double> coordinates = computeCoordinates(cage, middles, family);
        const std::vector<Vec3d> handles = cageHandles(cage, posed, family);
        double sum = 0;
        for (std::size_t i = 0; i < middles.size(); ++i)
            sum += (weighted(coordinates, i, handles) - targets[i]).length();
        return sum;
    };
    BOOST_TEST(off(Coordinates::biharmonic) < 0.5 * off(Coordinates::green));
}

BOOST_AUTO_TEST_CASE(points_on_the_cage_are_the_limit_from_inside)
{
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 9);
        const auto& p = cage.points;
        std::vector<Vec3d> on, near;
        for (const openvdb::Vec3I& t : detail::triangulateByShorterDiagonal(cage)) {
            on.push_back(0.5 * p[t[0]] + 0.3 * p[t[1]] + 0.2 * p[t[2]]);
            on.push_back(0.3 * p[t[0]] + 0.7 * p[t[1]]);
            on.push_back(p[t[2]]);
        }
        for (const Vec3d& x : on) near.push_back((1 - 1e-8) * x);
        const double off = difference(rowsOf(cage, on), rowsOf(cage, near));
        BOOST_TEST(off < 2e-6); // weights of normals have a logarithm of the distance in them
        BOOST_TEST(off > 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(smooth_across_the_planes_of_faces)
{
    const Mesh cage = test::cageFor(Coordinates::biharmonic, randomCage(Kind::both, 10, 0.3));
    const UnitCage bound(cage);
    const BiharmonicCage solved(bound);
    constexpr double step = 1e-4;
    int tried = 0;
    for (std::size_t face = 0; face < cage.triangles.size(); ++face) {
        const openvdb::Vec3I t = cage.triangles[face];
        const Vec3d a = cage.points[t[0]], b = cage.points[t[1]], c = cage.points[t[2]];
        const Vec3d normal = (b - a).cross(c - a).unit();
        const Vec3d x = a.dot(normal) * normal + 0.4 * (a - b); // in the plane
        if (x.length() > 0.6) continue;
        ++tried;
        std::vector<Vec3d> points;
        for (int i = -3; i <= 3; ++i) points.push_back(x + step * i * normal);
        const Rows rows = rowsOf(bound, solved, points);
        for (std::size_t k = 0; k < rows[0].size(); ++k) {
            const auto slope = [&](std::size_t i) { return (rows[i + 1][k] - rows[i][k]) / step; };
            BOOST_TEST(std::abs(slope(0) - slope(5)) < 100 * step); // bounds of second derivatives times the distance
            BOOST_TEST(std::abs(slope(2) - slope(3)) < 20 * step);
        }
    }
    BOOST_TEST(tried > 0);
}

BOOST_AUTO_TEST_CASE(same_bytes_for_any_number_of_threads_and_neighbours)
{
    const Mesh cage = test::cageFor(Coordinates::biharmonic, randomCage(Kind::both, 14, 0.2, 2)); // several tiles
    const std::vector<Vec3d> points = pointsInside(cage, 14, 40);
    const Rows all = rowsOf(cage, points);
    BOOST_TEST(all[0].size() > 200);
    const UnitCage bound(cage);
    const BiharmonicCage solved(bound);
    for (const std::size_t together : {std::size_t(1), std::size_t(3)})
        BOOST_TEST((rowsOf(bound, solved, points, together) == all));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST((rowsOf(cage, points) == all));
}

BOOST_AUTO_TEST_CASE(points_outside)
{
    const Mesh torus = test::cageFor(Coordinates::biharmonic, test::torus(3, 1, 12, 6));
    const UnitCage bound(torus);
    const BiharmonicCage cage(bound);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3d> points{Vec3d(0),           Vec3d(3, 0, 1.1), Vec3d(3, 0, 0),  Vec3d(4.1, 0, 0),
                                    Vec3d(1e300, 0, 0), Vec3d(3, nan, 0), Vec3d(-3, 0, 0), Vec3d(1e4, 0, 0)};
    std::vector<Vec3d> scaled;
    for (const Vec3d& p : points) scaled.push_back(bound.scaled(p));
    std::vector<std::array<double, detail::packetSize>> rows(cage.columns());
    auto* const packet = reinterpret_cast<detail::Packet*>(rows.data());
    BOOST_TEST(cage.rows(scaled.data(), 8, packet) == 0b10111011U);
    const Rows alone = rowsOf(torus, {points[2]});
    for (std::size_t k = 0; k < rows.size(); ++k) BOOST_TEST(rows[k][2] == alone[0][k]);
    BOOST_CHECK_EXCEPTION(computeCoordinates(torus, {Vec3d(3, 0, 0), Vec3d(0)}, Coordinates::biharmonic), InputError,
                          [](const InputError& error) {
                              return std::string(error.what()) ==
                                     "points: biharmonic coordinates are not defined at 1 of 2 points, first at point "
                                     "1, (0, 0, 0); all must be inside of the cage";
                          });
}

BOOST_AUTO_TEST_CASE(too_large_cages)
{
    const Mesh cage = test::torus(3, 1, 50, 41); // 2050 points, 4100 triangles
    BOOST_CHECK_EXCEPTION(computeCoordinates(cage, {}, Coordinates::biharmonic), InputError,
                          [](const InputError& error) {
                              return std::string(error.what()) ==
                                     "cage: it has 2050 points and 4100 triangles; biharmonic coordinates allow 6000 "
                                     "of both together";
                          });
}

BOOST_AUTO_TEST_CASE(slivers_and_unused_points)
{
    const Mesh plain = randomCage(Kind::triangles, 11);
    const std::vector<Vec3d> points = pointsInside(plain, 11, 30);
    for (const double off : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
        Mesh cage = test::withSliver(plain, off);
        cage.points.emplace_back(0.5, 0.5, 7); // of no face
        const Rows rows = rowsOf(cage, points);
        BOOST_TEST_CONTEXT("sliver " << off)
        {
            for (const Function& function : affine) BOOST_TEST(error(cage, points, rows, function) < 1e-10);
            BOOST_TEST(error(cage, points, rows, biharmonics[0]) < 0.2);
            double most = 0;
            for (const std::vector<double>& row : rows) {
                BOOST_TEST(row[cage.points.size() - 1] == 0);
                for (std::size_t k = 0; k < cage.points.size(); ++k) most = std::max(most, std::abs(row[k]));
            }
            BOOST_TEST(most < 3);
        }
    }
}

BOOST_AUTO_TEST_CASE(thin_cages)
{
    for (const Vec3d& scale : {Vec3d(1, 1, 1e-3), Vec3d(1, 1e-3, 1e-3), Vec3d(1, 1e-2, 1e-4)}) {
        Mesh cage = randomCage(Kind::both, 12);
        std::vector<Vec3d> points = pointsInside(test::cageFor(Coordinates::biharmonic, cage), 12, 30);
        for (Vec3d& p : cage.points) p *= scale;
        for (Vec3d& p : points) p *= scale;
        const Rows rows = rowsOf(cage, points);
        double most = 0;
        for (const std::vector<double>& row : rows) {
            for (std::size_t k = 0; k < cage.points.size(); ++k) most = std::max(most, std::abs(row[k]));
        }
        BOOST_TEST_MESSAGE("thin: weights up to " << most);
        for (const Function& function : affine) {
            const double off = error(cage, points, rows, function);
            BOOST_TEST_MESSAGE("off " << off);
            BOOST_TEST(off < 1e-10);
        }
        BOOST_TEST(most < 3);
    }
}

BOOST_AUTO_TEST_CASE(quads_are_halved_along_the_shorter_diagonal)
{
    Mesh mesh;
    mesh.points = {Vec3d(1, 1, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(3, 3, 0), Vec3d(0, 0, 1)};
    mesh.triangles = {{0, 2, 5}};
    mesh.quads = {{3, 0, 1, 2}, {2, 3, 4, 1}, {1, 2, 3, 4}}; // a square: 0 is the least; 1-3 is shorter
    const std::vector<openvdb::Vec3I> expected{{0, 2, 5}, {0, 1, 2}, {0, 2, 3}, {3, 4, 1},
                                               {3, 1, 2}, {1, 2, 3}, {1, 3, 4}};
    BOOST_TEST((detail::triangulateByShorterDiagonal(mesh) == expected));
}

BOOST_AUTO_TEST_CASE(can_be_cancelled)
{
    const UnitCage cage(test::cageFor(Coordinates::biharmonic, randomCage(Kind::both, 15)));
    test::StopAt never(1000000);
    const BiharmonicCage solved(cage, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > int(cage.points().size() + cage.faces().size()));
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(BiharmonicCage(cage, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(binding_and_weights_file)
{
    const Mesh cage = randomCage(Kind::both, 16);
    const std::vector<Vec3d> points = pointsInside(test::cageFor(Coordinates::biharmonic, cage), 16, 40);
    std::vector<Vec3d> posed = cage.points;
    for (Vec3d& p : posed) p *= 1 + 0.2 * p.x();
    const std::vector<float> weights = computeWeights(cage, points, Coordinates::biharmonic);
    const Binding binding(cage, points, Coordinates::biharmonic);
    const Binding taken(cage, points, Coordinates::biharmonic, weights);
    BOOST_TEST((binding.pose(posed) == taken.pose(posed)));
    // The name takes the longer field of weights files.
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "vdbcage_test_biharmonic.npy";
    writeWeights(cage, points, Coordinates::biharmonic, weights, path);
    const Binding read = readWeights(path, cage, points);
    std::filesystem::remove(path);
    BOOST_TEST((read.family() == Coordinates::biharmonic));
    BOOST_TEST((read.pose(posed) == taken.pose(posed)));
}

BOOST_AUTO_TEST_SUITE_END()
