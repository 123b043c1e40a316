#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

#include <deform/cages.h>
#include <openvdb/math/Mat3.h>
#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/triangles.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::cageFor;
using test::Kind;
using test::kinds;
using test::longestSide;
using test::mapped;
using test::pointsInside;
using test::Random;
using test::randomCage;
using test::rotation;
using test::weighted;

namespace {

const std::vector<Coordinates> families = test::exactFamilies();

Mesh moved(Mesh cage, const std::vector<Vec3d>& points)
{
    cage.points = points;
    return cage;
}

// The largest distance between what the coordinates make of the cage's image and the points' image.
template <typename Map>
double error(const Mesh& cage, const std::vector<Vec3d>& points, Coordinates family, const Map& map)
{
    const std::vector<double> coordinates = computeCoordinates(cage, points, family);
    const std::vector<Vec3d> handles = cageHandles(cage, mapped(cage.points, map), family);
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        most = std::max(most, (weighted(coordinates, i, handles) - map(points[i])).length());
    }
    return most;
}

std::string messageOf(const Mesh& cage, const std::vector<Vec3d>& points, Coordinates family)
{
    try {
        computeCoordinates(cage, points, family);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

// --- The defining integrals, by a rule that is refined until two levels agree, in long double.

using Real = long double;
struct Vec {
    Real x, y, z;
};
Vec operator+(Vec a, Vec b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(Vec a, Vec b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(Real s, Vec a)
{
    return {s * a.x, s * a.y, s * a.z};
}
Real dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Values = std::array<Real, 12>; // of each corner: mean value, double layer, single layer

struct Face {
    std::vector<Vec> corners;

    // The integrands at parameters of the face: the barycentric square that is folded to the triangle, or the patch.
    Values at(Real u, Real v) const
    {
        std::array<Real, 4> basis{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        Vec p, normal;
        Real density = 1;
        const std::vector<Vec>& c = corners;
        if (c.size() == 4) {
            p = basis[0] * c[0] + basis[1] * c[1] + basis[2] * c[2] + basis[3] * c[3];
            normal = cross((1 - v) * (c[1] - c[0]) + v * (c[2] - c[3]), (1 - u) * (c[3] - c[0]) + u * (c[2] - c[1]));
        } else {
            basis = {1 - u, u * (1 - v), u * v, 0};
            density = u;
            p = basis[0] * c[0] + basis[1] * c[1] + basis[2] * c[2];
            normal = u * cross(c[1] - c[0], c[2] - c[0]);
        }
        const Real r = std::sqrt(dot(p, p)), pi = std::acos(Real(-1));
        Values values;
        for (std::size_t i = 0; i < 4; ++i) {
            values[i] = basis[i] * dot(p, normal) / (r * r * r * r);
            values[4 + i] = basis[i] * dot(p, normal) / (r * r * r) / (4 * pi);
            values[8 + i] = (c.size() == 4 ? basis[i] : density * Real(i == 0)) / r / (4 * pi);
        }
        return values;
    }

    Values rule(Real u, Real v, Real size) const // Boole's, 5 x 5
    {
        constexpr Real weights[] = {7, 32, 12, 32, 7};
        Values sum{};
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) {
                const Values values = at(u + size * Real(i) / 4, v + size * Real(j) / 4);
                for (std::size_t k = 0; k < 12; ++k) sum[k] += size * size * weights[i] * weights[j] / 8100 * values[k];
            }
        }
        return sum;
    }

    Values integral(Real u = 0, Real v = 0, Real size = 1, int depth = 0) const
    {
        const Values coarse = rule(u, v, size);
        const Real middle = size / 2;
        Values fine{};
        for (const auto& corner : {std::pair{u, v}, {u + middle, v}, {u, v + middle}, {u + middle, v + middle}}) {
            const Values part = rule(corner.first, corner.second, middle);
            for (std::size_t k = 0; k < 12; ++k) fine[k] += part[k];
        }
        Real difference = 0;
        for (std::size_t k = 0; k < 12; ++k) difference = std::max(difference, std::abs(fine[k] - coarse[k]));
        if ((difference < 1e-9L && depth > 1) || depth == 14) return fine;
        fine = {};
        for (const auto& corner : {std::pair{u, v}, {u + middle, v}, {u, v + middle}, {u + middle, v + middle}}) {
            const Values part = integral(corner.first, corner.second, middle, depth + 1);
            for (std::size_t k = 0; k < 12; ++k) fine[k] += part[k];
        }
        return fine;
    }
};

std::vector<std::vector<openvdb::Index32>> facesOf(const Mesh& cage)
{
    std::vector<std::vector<openvdb::Index32>> faces;
    for (const auto& t : cage.triangles) faces.push_back({t[0], t[1], t[2]});
    for (const auto& q : cage.quads) faces.push_back({q[0], q[1], q[2], q[3]});
    return faces;
}

Vec from(const Vec3d& p, const Vec3d& x)
{
    return Vec{p.x(), p.y(), p.z()} - Vec{x.x(), x.y(), x.z()};
}

// The weights of face vectors that balance, of greatest product: coordinate by coordinate, by bisection.
std::vector<Real> balanced(const std::vector<Vec>& vectors)
{
    std::array<Real, 3> s{};
    const auto component = [](const Vec& z, int axis) { return axis == 0 ? z.x : axis == 1 ? z.y : z.z; };
    const auto factor = [&](const Vec& z) { return 1 + s[0] * z.x + s[1] * z.y + s[2] * z.z; };
    for (int round = 0; round < 4000; ++round) {
        Real change = 0;
        for (int axis = 0; axis < 3; ++axis) {
            Real& at = s[static_cast<std::size_t>(axis)];
            const Real before = at;
            Real low = at - 1e3L, high = at + 1e3L; // first to where all factors are positive
            for (const Vec& z : vectors) {
                const Real c = component(z, axis);
                if (c > 0) low = std::max(low, at - factor(z) / c);
                if (c < 0) high = std::min(high, at - factor(z) / c);
            }
            for (int step = 0; step < 100; ++step) {
                at = (low + high) / 2;
                Real slope = 0;
                for (const Vec& z : vectors) slope += component(z, axis) / factor(z);
                (slope > 0 ? low : high) = at;
            }
            change = std::max(change, std::abs(at - before));
        }
        if (change < 1e-15L) break;
    }
    std::vector<Real> weights;
    for (const Vec& z : vectors) weights.push_back(1 / factor(z));
    return weights;
}

std::vector<double> reference(const Mesh& cage, const Vec3d& x, Coordinates family)
{
    const auto faces = facesOf(cage);
    std::vector<Values> integrals;
    std::vector<Vec> vectors;
    for (const auto& face : faces) {
        Face seen;
        for (const openvdb::Index32 i : face) seen.corners.push_back(from(cage.points[i], x));
        integrals.push_back(seen.integral());
        if (family == Coordinates::maximumLikelihood) {
            Vec vector{0, 0, 0};
            Real total = 0;
            for (std::size_t k = 0; k < face.size(); ++k) {
                vector = vector + std::abs(integrals.back()[k]) * seen.corners[k];
                total += std::abs(integrals.back()[k]);
            }
            // Lengths in units of the cage's longest side; a common factor of all vectors changes nothing.
            const Real distance = std::sqrt(dot(vector, vector)) / total + 0.02L * longestSide(cage);
            for (Real& value : integrals.back()) value /= distance * distance;
            vectors.push_back((1 / (distance * distance)) * vector);
        }
    }
    std::vector<Real> factors(faces.size(), 1);
    if (family == Coordinates::maximumLikelihood) factors = balanced(vectors);
    std::vector<Real> row(cage.points.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < faces[f].size(); ++k) {
            Real value = integrals[f][(family == Coordinates::green ? 4 : 0) + k];
            if (family == Coordinates::maximumLikelihood) value = std::abs(value);
            row[faces[f][k]] += factors[f] * value;
        }
    }
    if (family == Coordinates::green) {
        const double size = longestSide(cage); // the unit of the normals' weights
        for (std::size_t f = 0; f < faces.size(); ++f) {
            for (std::size_t k = 0; k < (faces[f].size() == 4 ? 4 : 1); ++k) row.push_back(size * integrals[f][8 + k]);
        }
    } else {
        Real sum = 0;
        for (const Real w : row) sum += w;
        for (Real& w : row) w /= sum;
    }
    return {row.begin(), row.end()};
}

} // namespace

BOOST_AUTO_TEST_SUITE(coordinates)

BOOST_AUTO_TEST_CASE(rest_pose_and_partition_of_unity)
{
    for (const Coordinates family : families) {
        for (const Kind kind : kinds) {
            for (std::uint32_t seed = 0; seed < 4; ++seed) {
                const Mesh cage = cageFor(family, randomCage(kind, seed));
                const std::vector<Vec3d> points = pointsInside(cage, seed);
                const std::vector<double> coordinates = computeCoordinates(cage, points, family);
                const std::vector<Vec3d> handles = cageHandles(cage, cage.points, family);
                BOOST_REQUIRE(coordinates.size() == points.size() * handles.size());
                double off = 0, lacking = 0;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    off = std::max(off, (weighted(coordinates, i, handles) - points[i]).length());
                    double sum = -1;
                    for (std::size_t k = 0; k < cage.points.size(); ++k) sum += coordinates[i * handles.size() + k];
                    lacking = std::max(lacking, std::abs(sum));
                }
                BOOST_TEST_CONTEXT(coordinatesName(family) << " kind " << int(kind) << " seed " << seed)
                {
                    BOOST_TEST(off < 1e-12);
                    BOOST_TEST(lacking < 1e-12);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(affine_maps_are_kept)
{
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 5);
        const std::vector<Vec3d> points = pointsInside(cage, 5);
        const openvdb::Mat3d turn = rotation(1);
        const openvdb::Mat3d affine = turn * openvdb::Mat3d(2.0, 0.5, 0.0, 0.0, 0.7, -1.0, 0.3, 0.0, 1.1);
        const Vec3d shift(3, -2, 1);
        const auto affinely = [&](const Vec3d& p) { return affine * p + shift; };
        const auto similarly = [&](const Vec3d& p) { return 1.7 * (turn * p) + shift; };
        BOOST_TEST(error(cage, points, Coordinates::meanValue, affinely) < 1e-11);
        BOOST_TEST(error(cage, points, Coordinates::maximumLikelihood, affinely) < 1e-11);
        BOOST_TEST(error(cage, points, Coordinates::green, similarly) < 1e-11);
        BOOST_TEST(error(cage, points, Coordinates::green, affinely) > 1e-3); // they keep shapes instead
    }
}

BOOST_AUTO_TEST_CASE(a_similarity_of_cage_and_points_changes_nothing)
{
    for (const Coordinates family : families) {
        const Mesh cage = cageFor(family, randomCage(Kind::both, 6));
        const std::vector<Vec3d> points = pointsInside(cage, 6);
        // A quarter turn keeps the longest side, and so what counts as near.
        const openvdb::Mat3d turn(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        const auto similarly = [&](const Vec3d& p) { return 1e-3 * (turn * p) + Vec3d(0.1, 0, 0); };
        const std::vector<double> a = computeCoordinates(cage, points, family);
        const Mesh other = moved(cage, mapped(cage.points, similarly));
        const std::vector<double> b = computeCoordinates(other, mapped(points, similarly), family);
        double most = 0;
        for (std::size_t i = 0; i < a.size() / 2; ++i) { // the last points are too near for their moved digits
            most = std::max(most, std::abs(a[i] - b[i]));
        }
        BOOST_TEST(most < 1e-8);
    }
}

// Those of Somigliana coordinates are in test_somigliana.cpp.
BOOST_AUTO_TEST_CASE(the_defining_integrals)
{
    for (const Coordinates family : {Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood}) {
        for (const Kind kind : kinds) {
            const Mesh cage = randomCage(kind, 7, 0.15);
            std::vector<Vec3d> points{Vec3d(0.1, -0.2, 0.05), Vec3d(-0.55, 0.2, 0.3)};
            const auto face = facesOf(cage)[5];
            points.push_back(0.99 * 0.5 * (cage.points[face[0]] + cage.points[face[2]])); // near an edge or a diagonal
            points.push_back(0.9 * cage.points[face[1]]);
            if (family == Coordinates::meanValue) points.emplace_back(2, 1, 0.5);
            const std::vector<double> coordinates = computeCoordinates(cage, points, family);
            const std::size_t columns = coordinates.size() / points.size();
            for (std::size_t i = 0; i < points.size(); ++i) {
                const std::vector<double> expected = reference(cage, points[i], family);
                BOOST_REQUIRE(expected.size() == columns);
                double most = 0;
                for (std::size_t k = 0; k < columns; ++k) {
                    most = std::max(most, std::abs(coordinates[i * columns + k] - expected[k]));
                }
                BOOST_TEST_CONTEXT(coordinatesName(family) << " kind " << int(kind) << " point " << i)
                {
                    BOOST_TEST(most < 1e-7);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(points_on_the_cage)
{
    const Mesh cage = randomCage(Kind::both, 8);
    const auto& p = cage.points;
    const openvdb::Vec4I q = cage.quads[3];
    const openvdb::Vec3I t = cage.triangles[2];
    const std::vector<Vec3d> points{p[q[1]], 0.25 * p[q[1]] + 0.75 * p[q[2]],
                                    0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]),
                                    0.5 * p[t[0]] + 0.3 * p[t[1]] + 0.2 * p[t[2]]};
    for (const Coordinates family : {Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood}) {
        const std::vector<double> on = computeCoordinates(cage, points, family);
        const std::size_t columns = on.size() / points.size();
        const std::vector<double> inside =
            computeCoordinates(cage, mapped(points, [](const Vec3d& x) { return (1 - 1e-8) * x; }), family);
        double most = 0; // they are continuous up to the cage
        for (std::size_t i = 0; i < on.size(); ++i) most = std::max(most, std::abs(on[i] - inside[i]));
        BOOST_TEST(most < 1e-6);
        if (family == Coordinates::green) continue;
        const auto weight = [&](std::size_t i, openvdb::Index32 corner) { return on[i * columns + corner]; };
        BOOST_TEST(std::abs(weight(0, q[1]) - 1) < 1e-12); // they interpolate it
        BOOST_TEST(std::abs(weight(1, q[1]) - 0.25) < 1e-12);
        BOOST_TEST(std::abs(weight(1, q[2]) - 0.75) < 1e-12);
        for (int k = 0; k < 4; ++k) BOOST_TEST(std::abs(weight(2, q[k]) - 0.25) < 1e-12);
        BOOST_TEST(std::abs(weight(3, t[0]) - 0.5) < 1e-12);
        BOOST_TEST(std::abs(weight(3, t[2]) - 0.2) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(likelihood_weights_are_not_negative_and_local)
{
    const Mesh cage = test::torus(3, 1, 12, 6);
    Random random(9);
    std::vector<Vec3d> points;
    for (int i = 0; i < 300; ++i) {
        const double around = random(0, 6.28), across = random(0, 6.28), tube = random(0, 0.7);
        const double reach = 3 + tube * std::cos(across);
        points.emplace_back(reach * std::cos(around), reach * std::sin(around), tube * std::sin(across));
    }
    const auto least = [&](Coordinates family) {
        const std::vector<double> coordinates = computeCoordinates(cage, points, family);
        return *std::min_element(coordinates.begin(), coordinates.end());
    };
    // What the vertices beyond the ring's hole weigh.
    const auto far = [&](Coordinates family) {
        const std::vector<double> coordinates = computeCoordinates(cage, points, family);
        double sum = 0;
        for (std::size_t i = 0; i < coordinates.size(); ++i) {
            const Vec3d &point = points[i / cage.points.size()], &vertex = cage.points[i % cage.points.size()];
            if ((point - vertex).length() > 3) sum += std::abs(coordinates[i]);
        }
        return sum;
    };
    BOOST_TEST(far(Coordinates::maximumLikelihood) < 0.3 * far(Coordinates::meanValue));
    BOOST_TEST(least(Coordinates::maximumLikelihood) >= 0);
    BOOST_TEST(least(Coordinates::meanValue) < -0.001);
    BOOST_TEST(error(cage, points, Coordinates::maximumLikelihood, [](const Vec3d& p) { return p; }) < 1e-12);
}

BOOST_AUTO_TEST_CASE(degenerate_faces)
{
    // An edge of the cage becomes a sliver, a face of no area, or nearly one.
    for (const double height : {0.0, 1e-14, 1e-9, 1e-5}) {
        const Mesh cage = test::withSliver(randomCage(Kind::triangles, 10), height);
        const std::vector<Vec3d> points = pointsInside(cage, 10);
        for (const Coordinates family : families) {
            BOOST_TEST_CONTEXT(coordinatesName(family) << " height " << height)
            {
                BOOST_TEST(error(cage, points, family, [](const Vec3d& p) { return p; }) < 1e-12);
            }
        }
    }
}

// Once they were integrated without end.
BOOST_AUTO_TEST_CASE(points_in_line_with_the_corners_of_a_quad)
{
    Mesh cage = randomCage(Kind::quads, 19);
    const openvdb::Vec4I q = cage.quads[2];
    const Vec3d a = cage.points[q[0]], b = cage.points[q[1]];
    cage.points[q[2]] = 0.7 * a + 0.3 * b;
    cage.points[q[3]] = 0.2 * a + 0.8 * b;
    const std::vector<Vec3d> points{Vec3d(0), 0.55 * a + 0.45 * b, 0.55 * a + 0.45 * b + Vec3d(1e-11, 0, 0)};
    for (const Coordinates family : families) {
        const std::string message = messageOf(cage, points, family);
        BOOST_TEST((message.empty() || message.find("points: point") == 0), message);
    }
}

BOOST_AUTO_TEST_CASE(far_from_the_origin_and_of_any_size)
{
    for (const double size : {1e-60, 1.0, 1e60}) {
        const auto map = [&](const Vec3d& p) { return size * (p + Vec3d(1000, 0, 0)); };
        Mesh cage = randomCage(Kind::both, 11);
        cage.points = mapped(cage.points, map);
        const std::vector<Vec3d> points = mapped({Vec3d(0), Vec3d(0.3, 0.2, -0.4)}, map);
        for (const Coordinates family : families) {
            BOOST_TEST(error(cage, points, family, [](const Vec3d& p) { return p; }) < 1e-12 * 2000 * size);
        }
    }
}

BOOST_AUTO_TEST_CASE(points_outside)
{
    const Mesh cage = randomCage(Kind::both, 12);
    const std::vector<Vec3d> points{Vec3d(0), Vec3d(2, 0, 0), Vec3d(0, 5, 0)};
    const auto same = [](const Vec3d& p) { return p; };
    BOOST_TEST(error(cage, points, Coordinates::meanValue, same) < 1e-11);
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (family.isEverywhere) continue;
        BOOST_TEST(messageOf(cage, points, family.family) ==
                   "points: " + std::string(family.name) +
                       " coordinates are not defined at 2 of 3 points, first at point 1, (2, 0, 0); all must be inside "
                       "of the cage");
    }
}

BOOST_AUTO_TEST_CASE(loose_points_ride_along_or_stay)
{
    const Mesh cage = randomCage(Kind::both, 12);
    const std::vector<Vec3d> points{Vec3d(0), Vec3d(2, 0, 0), Vec3d(0.1, 0, 0), Vec3d(0, 5, 0)};
    std::vector<Vec3d> posed = cage.points;
    for (Vec3d& p : posed) p = Vec3d(p[0] + 0.3 * p[1] * p[1], 1.2 * p[1], p[2]);
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (family.isEverywhere) continue;
        const Mesh faces = cageFor(family.family, cage);
        const std::vector<Vec3d> byMeanValue = Binding(faces, points, Coordinates::meanValue).pose(posed);
        CoordinateOptions options(family.family, 24);
        const std::vector<Vec3d> inside = Binding(cage, {points[0], points[2]}, options).pose(posed);
        options.loose.indices = {1, 2, 3};
        const Binding riding(cage, points, options);
        const std::vector<Vec3d> at = riding.pose(posed);
        BOOST_TEST_CONTEXT(family.name)
        {
            BOOST_TEST((at[0] - inside[0]).length() < 1e-6);
            BOOST_TEST((at[2] - inside[1]).length() < 1e-6); // it is inside
            BOOST_TEST((at[1] - byMeanValue[1]).length() < 1e-5);
            BOOST_TEST((at[3] - byMeanValue[3]).length() < 1e-5);
            BOOST_TEST((at[3] - points[3]).length() > 0.1);
            const std::vector<float> weights = computeWeights(cage, points, options);
            BOOST_TEST((Binding(cage, points, options, weights).pose(posed) == at));
            options.loose.motion = LoosePoints::Motion::stay;
            const std::vector<Vec3d> still = Binding(cage, points, options).pose(posed);
            for (const std::size_t i : {1, 2, 3}) BOOST_TEST(still[i] == points[i]);
            BOOST_TEST((still[0] - inside[0]).length() < 1e-6);
            options.loose.indices = {1}; // another one is outside
            BOOST_CHECK_THROW(Binding(cage, points, options), InputError);
            options.loose.indices = {4};
            BOOST_CHECK_THROW(Binding(cage, points, options), InputError);
        }
    }
}

// Once vectors of such points were integrated without end.
BOOST_AUTO_TEST_CASE(points_so_far_that_squares_overflow)
{
    for (const Kind kind : kinds) {
        const Mesh cage = randomCage(kind, 18);
        const std::vector<double> at = computeCoordinates(cage, {Vec3d(0.1, 0.2, 0)}, Coordinates::meanValue);
        for (const double far : {1e4, 1e160, 1e300}) {
            const std::vector<Vec3d> points{Vec3d(far), Vec3d(0.1, 0.2, 0), Vec3d(0, 0, -far)};
            for (const Coordinates family : families) {
                if (familyInfo(family).isEverywhere) continue;
                BOOST_TEST(messageOf(cage, points, family).find("point 0") != std::string::npos);
            }
            const std::string message = messageOf(cage, points, Coordinates::meanValue);
            BOOST_TEST((message.empty() || message.find("none may be so far away") != std::string::npos), message);
            if (!message.empty()) continue;
            const std::vector<double> rows = computeCoordinates(cage, points, Coordinates::meanValue);
            BOOST_TEST(std::equal(at.begin(), at.end(), rows.begin() + static_cast<std::ptrdiff_t>(at.size())));
        }
    }
}

BOOST_AUTO_TEST_CASE(bad_cages)
{
    const std::vector<Vec3d> points{Vec3d(0)};
    const auto contains = [&](const Mesh& cage, const char* text) {
        const std::string message = messageOf(cage, points, Coordinates::meanValue);
        BOOST_TEST(message.find(text) != std::string::npos, message << " lacks " << text);
    };
    Mesh cage = randomCage(Kind::both, 13);
    Mesh open = cage;
    open.quads.pop_back();
    contains(open, "cage: it is not closed and oriented (4 boundary edges");
    Mesh inward = cage;
    for (auto& t : inward.triangles) std::swap(t[0], t[1]);
    for (auto& q : inward.quads) std::swap(q[1], q[3]);
    contains(inward, "cage: it faces inward");
    Mesh flat = cage;
    for (Vec3d& p : flat.points) p.z() = 0;
    contains(flat, "cage: it is flat");
    contains(Mesh(), "cage: it has no faces");
    BOOST_CHECK_THROW(computeCoordinates(cage, {Vec3d(std::nan(""), 0, 0)}, Coordinates::green), InputError);
    BOOST_CHECK_THROW(cageHandles(cage, {Vec3d(0)}, Coordinates::green), InputError);
    BOOST_TEST(computeCoordinates(cage, {}, Coordinates::green).empty());
}

BOOST_AUTO_TEST_CASE(same_bytes_for_any_number_of_threads)
{
    for (const Coordinates family : families) {
        const Mesh cage = cageFor(family, randomCage(Kind::both, 14));
        const std::vector<Vec3d> points = pointsInside(cage, 14, 300);
        const std::vector<double> all = computeCoordinates(cage, points, family);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        BOOST_TEST((computeCoordinates(cage, points, family) == all));
    }
}

BOOST_AUTO_TEST_CASE(can_be_cancelled)
{
    const Mesh cage = randomCage(Kind::both, 15);
    const std::vector<Vec3d> points = pointsInside(cage, 15, 100);
    test::StopAt never(1000000);
    computeCoordinates(cage, points, Coordinates::green, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > int(points.size())); // each may take a millisecond
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(computeCoordinates(cage, points, Coordinates::green, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(names)
{
    std::size_t value = 0;
    for (const FamilyInfo& family : coordinateFamilies()) {
        BOOST_TEST((family.family == static_cast<Coordinates>(value++)));
        BOOST_TEST((familyInfo(family.family).family == family.family));
        BOOST_TEST(std::string(family.name).size() <= 16); // of weights files
        BOOST_TEST(coordinatesName(family.family) == std::string(family.name));
        BOOST_TEST((coordinatesNamed(family.name) == family.family));
        BOOST_TEST((coordinatesNamed(family.nameOnQuads) == family.family));
    }
    BOOST_TEST((static_cast<Coordinates>(value) == Coordinates::given));
    BOOST_TEST((familyInfo(Coordinates::given).family == Coordinates::given));
    BOOST_TEST((coordinatesNamed("qmvc") == Coordinates::meanValue));
    BOOST_TEST((coordinatesNamed("qgc") == Coordinates::green));
    BOOST_CHECK_EXCEPTION(coordinatesNamed("bounded"), InputError, [](const InputError& error) {
        return error.what() == "coordinates: 'bounded' is not a family; " + test::thereAreFamilies();
    });
}

BOOST_AUTO_TEST_CASE(facts_are_true)
{
    const Mesh cage = randomCage(Kind::quads, 21);
    const Mesh split{cage.points, detail::triangulateByShorterDiagonal(cage), {}};
    const std::vector<Vec3d> points = pointsInside(cage, 21, 10);
    const std::vector<Vec3d> posed = test::jittered(cage.points, 21);
    const Elasticity soft{0.3, Elasticity::Rotations::local, 0, 0};
    for (const FamilyInfo& info : coordinateFamilies()) {
        const auto weights = [&](const Mesh& mesh, int resolution) {
            return computeWeights(mesh, {points[0], points[3]}, {info.family, resolution});
        };
        BOOST_TEST_CONTEXT(info.name)
        {
            BOOST_TEST((weights(cage, 8) != weights(cage, 9)) == info.hasResolution);
            BOOST_TEST((cageHandles(cage, posed, info.family) != cageHandles(cage, posed, {info.family, soft})) ==
                       info.hasElasticity);
            BOOST_TEST((weights(cage, 8) == weights(split, 8)) == info.splitsQuads);
            BOOST_TEST(messageOf(cage, {Vec3d(0, 0, 3)}, info.family).empty() == info.isEverywhere);
        }
    }
}

BOOST_AUTO_TEST_CASE(room_for_many_is_taken_in_steps)
{
    const Mesh cage = randomCage(Kind::triangles, 17);
    const std::vector<Vec3d> points(400000, Vec3d(0)); // 10 million weights
    const std::size_t step = std::size_t(1) << 22;
    const auto steps = int(points.size() * cage.points.size() / step);
    BOOST_TEST(steps >= 2);
    test::StopAt never(1000000);
    computeWeights(cage, points, Coordinates::meanValue, &never);
    BOOST_TEST(test::questions(never, 1000000) > int(points.size()) + steps);
}

BOOST_AUTO_TEST_SUITE_END()
