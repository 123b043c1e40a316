#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include <deform/cages.h>
#include <openvdb/math/Mat3.h>
#include <support/shapes.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/gauss.h>
#include <vdbcage/deform/distortion.h>

using namespace vdbcage;
using detail::pi;
using openvdb::Mat3d;
using openvdb::Vec3d;
using test::jittered;
using test::Kind;
using test::mapped;
using test::Random;
using test::randomCage;
using test::rotation;
using test::weighted;

namespace {

using Rotations = Elasticity::Rotations;

struct Triangle {
    std::array<Vec3d, 3> corners;
    std::array<Vec3d, 3> values; // at the corners

    Triangle part(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b, const std::array<Vec3d, 3>& c) const
    {
        Triangle result;
        const std::array<std::array<Vec3d, 3>, 3> all{a, b, c};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d& w = all[i][0];
            result.corners[i] = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
            result.values[i] = w[0] * values[0] + w[1] * values[1] + w[2] * values[2];
        }
        return result;
    }
};

/// Calls `visit(place, value, area)` with samples of a triangle, which is split until it is small for its distance from
/// `x`; `value` is linear between those of the corners.
template <typename Visit>
void sample(const Triangle& t, const Vec3d& x, const Visit& visit)
{
    const Vec3d middle = (t.corners[0] + t.corners[1] + t.corners[2]) / 3;
    double radius = 0;
    for (const Vec3d& corner : t.corners) radius = std::max(radius, (corner - middle).length());
    if (radius > 1e-9 && (middle - x).length() < 2.5 * radius) {
        const std::array<Vec3d, 3> a{Vec3d(1, 0, 0)}, b{Vec3d(0, 1, 0)}, c{Vec3d(0, 0, 1)};
        const std::array<Vec3d, 3> ab{Vec3d(0.5, 0.5, 0)}, bc{Vec3d(0, 0.5, 0.5)}, ca{Vec3d(0.5, 0, 0.5)};
        for (const Triangle& part : {t.part(a, ab, ca), t.part(ab, b, bc), t.part(ca, bc, c), t.part(ab, bc, ca)}) {
            sample(part, x, visit);
        }
        return;
    }
    const Vec3d normal = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
    const detail::GaussRule& rule = detail::gaussRule(10);
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j < 10; ++j) { // the square folded to the triangle
            const double v = rule.at[j], u = rule.at[i] * (1 - v), area = rule.weight[i] * rule.weight[j] * (1 - v);
            visit((1 - u - v) * t.corners[0] + u * t.corners[1] + v * t.corners[2],
                  (1 - u - v) * t.values[0] + u * t.values[1] + v * t.values[2], area * normal.length());
        }
    }
}

/// Somigliana's identity as textbooks have it: the displacement at `x` of the material with mu 1, whose surface moves
/// by `displacement(corner)` and is pulled by `traction(normal, triangle)`.
template <typename Displacement, typename Traction>
Vec3d identity(const Mesh& cage, const Vec3d& x, double nu, const Displacement& displacement, const Traction& traction)
{
    Vec3d sum(0);
    for (const openvdb::Vec3I& t : cage.triangles) {
        Triangle triangle;
        for (int k = 0; k < 3; ++k) {
            triangle.corners[std::size_t(k)] = cage.points[t[k]];
            triangle.values[std::size_t(k)] = displacement(t[k]);
        }
        const auto& c = triangle.corners;
        const Vec3d normal = (c[1] - c[0]).cross(c[2] - c[0]).unit();
        const Vec3d pull = traction(normal, t);
        sample(triangle, x, [&](const Vec3d& y, const Vec3d& u, double area) {
            const double r = (y - x).length();
            const Vec3d d = (y - x) / r;
            sum += area / (16 * pi * (1 - nu) * r) * ((3 - 4 * nu) * pull + d.dot(pull) * d);
            const double slope = d.dot(normal);
            sum += area / (8 * pi * (1 - nu) * r * r) *
                   (slope * ((1 - 2 * nu) * u + 3 * d.dot(u) * d) +
                    (1 - 2 * nu) * (d.dot(u) * normal - normal.dot(u) * d));
        });
    }
    return sum;
}

double volumeOf(const Mesh& mesh, const std::vector<Vec3d>& points)
{
    double volume = 0;
    for (const openvdb::Vec3I& t : triangulate(mesh)) {
        volume += points[t[0]].dot(points[t[1]].cross(points[t[2]])) / 6;
    }
    return volume;
}

/// The rotation that fits best by area, from Newton's method for the polar decomposition.
Mat3d fitted(const Mesh& cage, const std::vector<Vec3d>& posed)
{
    std::vector<double> areas(cage.points.size(), 0.0);
    double total = 0;
    for (const openvdb::Vec3I& t : triangulate(cage)) {
        const Vec3d& a = cage.points[t[0]];
        const double area = (cage.points[t[1]] - a).cross(cage.points[t[2]] - a).length();
        for (int k = 0; k < 3; ++k) areas[t[k]] += area;
        total += 3 * area;
    }
    Vec3d from(0), to(0);
    for (std::size_t i = 0; i < posed.size(); ++i) {
        from += areas[i] / total * cage.points[i];
        to += areas[i] / total * posed[i];
    }
    Mat3d matrix = Mat3d::zero();
    for (std::size_t i = 0; i < posed.size(); ++i) {
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                matrix(r, c) += areas[i] * (posed[i] - to)[r] * (cage.points[i] - from)[c];
            }
        }
    }
    for (int step = 0; step < 100; ++step) matrix = 0.5 * (matrix + matrix.inverse(0.0).transpose());
    return matrix;
}

/// Where the coordinates put the points.
std::vector<Vec3d> posedBy(const Mesh& cage, const std::vector<Vec3d>& points, const std::vector<Vec3d>& posed,
                           const Elasticity& elasticity)
{
    const std::vector<double> coordinates = computeCoordinates(cage, points, Coordinates::somigliana);
    const std::vector<Vec3d> handles = cageHandles(cage, posed, {Coordinates::somigliana, elasticity});
    std::vector<Vec3d> result;
    for (std::size_t i = 0; i < points.size(); ++i) result.push_back(weighted(coordinates, i, handles));
    return result;
}

double farthest(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).length());
    return most;
}

/// A bar along x, from -2 to 2 and 1 wide, of `pieces` rings of triangles; and the model that is in it.
Mesh bar(int pieces, double width = 1, double length = 4)
{
    Mesh mesh;
    for (int i = 0; i <= pieces; ++i) {
        for (int k = 0; k < 4; ++k) {
            const double side = 0.5 * width;
            mesh.points.emplace_back(length * (double(i) / pieces - 0.5), k == 1 || k == 2 ? side : -side,
                                     k > 1 ? side : -side);
        }
    }
    const auto at = [](int i, int k) { return static_cast<openvdb::Index32>(4 * i + k % 4); };
    for (int i = 0; i < pieces; ++i) {
        for (int k = 0; k < 4; ++k) mesh.quads.emplace_back(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
    mesh.quads.emplace_back(at(0, 3), at(0, 2), at(0, 1), at(0, 0));
    mesh.quads.emplace_back(at(pieces, 0), at(pieces, 1), at(pieces, 2), at(pieces, 3));
    return {mesh.points, triangulate(mesh), {}};
}

Vec3d bent(const Vec3d& p) // by a half turn over its length
{
    const double angle = p.x() * pi / 4, radius = 4 / pi;
    return {(radius - p.y()) * std::sin(angle), radius - (radius - p.y()) * std::cos(angle), p.z()};
}

/// Of a triangle whose frame turns with it: its handles tell the stretch in the plane, and the traction over mu.
struct Pull {
    Vec3d normal;
    double stretch, traction;
};

std::vector<Pull> pullsOf(const Mesh& cage, const std::vector<Vec3d>& posed, const Elasticity& material)
{
    BOOST_REQUIRE((material.rotations == Rotations::local));
    const std::vector<Vec3d> handles = cageHandles(cage, posed, {Coordinates::somigliana, material});
    const double size = test::longestSide(cage);
    std::vector<Pull> pulls;
    for (std::size_t face = 0; face < cage.triangles.size(); ++face) {
        const openvdb::Vec3I t = cage.triangles[face];
        const Vec3d normal = (posed[t[1]] - posed[t[0]]).cross(posed[t[2]] - posed[t[0]]).unit();
        const std::size_t at = cage.points.size() + 6 * face;
        const double trace = handles[at + 3].dot(normal) / size, alone = handles[at].dot(normal) / size - trace;
        const double turning = trace - (3 - 4 * material.nu) * alone;
        pulls.push_back({normal, -0.5 * turning, 4 * (1 - material.nu) * alone + 2 * turning});
    }
    return pulls;
}

const Elasticity materials[] = {{},
                                {-0.6, Rotations::global, 0, 0},
                                {0.4, Rotations::global, 5, 0},
                                {0.2, Rotations::local, 0, 0},
                                {-0.3, Rotations::local, 2, 3}};

} // namespace

BOOST_AUTO_TEST_SUITE(somigliana)

BOOST_AUTO_TEST_CASE(the_reference_is_exact_for_affine_maps)
{
    const Mesh cage = randomCage(Kind::triangles, 60);
    const Mat3d affine(2.0, 0.5, 0.0, 0.0, 0.7, -1.0, 0.3, 0.0, 1.1);
    const Vec3d x(0.1, -0.2, 0.3);
    for (const double nu : {-0.5, 0.0, 0.4}) {
        const double lambda = 2 * nu / (1 - 2 * nu), trace = affine(0, 0) + affine(1, 1) + affine(2, 2);
        const Vec3d y = identity(
            cage, x, nu, [&](openvdb::Index32 i) { return affine * cage.points[i]; },
            [&](const Vec3d& n, const openvdb::Vec3I&) {
                return (affine + affine.transpose()) * n + lambda * trace * n;
            });
        BOOST_TEST((y - affine * x).length() < 1e-9);
    }
}

// With one rotation for all faces the coordinates are the identity, whose kernels they took apart.
BOOST_AUTO_TEST_CASE(poses_are_those_of_the_identity)
{
    for (std::uint32_t seed = 61; seed < 64; ++seed) {
        const Mesh cage = randomCage(Kind::triangles, seed);
        const Mat3d turn = rotation(seed);
        const std::vector<Vec3d> posed =
            mapped(jittered(cage.points, seed, 0.4), [&](const Vec3d& p) { return 1.3 * (turn * p) + Vec3d(1, 2, 3); });
        const Mat3d fit = fitted(cage, posed);
        const double scale = std::cbrt(volumeOf(cage, posed) / volumeOf(cage, cage.points));
        const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.2, -0.3, 0.4), Vec3d(-0.5, 0.2, 0.1)};
        for (const double nu : {-0.7, 0.0, 0.3, 0.45}) {
            const std::vector<Vec3d> moved = posedBy(cage, points, posed, {nu, Rotations::global, 0, 0});
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Vec3d expected =
                    fit * identity(
                              cage, points[i], nu, [&](openvdb::Index32 k) { return fit.transpose() * posed[k]; },
                              [&](const Vec3d& normal, const openvdb::Vec3I&) {
                                  return scale * 2 * (1 + nu) / (1 - 2 * nu) * normal;
                              });
                BOOST_TEST((moved[i] - expected).length() < 1e-8, "nu " << nu << " point " << i);
            }
        }
    }
}

// No face turns where a box is stretched along its axes: so each has its own traction in the identity.
BOOST_AUTO_TEST_CASE(local_stretches_are_those_of_the_faces)
{
    const Mesh cage = bar(4);
    const Vec3d stretch(1.5, 0.8, 1.1);
    const std::vector<Vec3d> posed = mapped(cage.points, [&](const Vec3d& p) { return stretch * p; });
    const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.4, -0.1, 0.2), Vec3d(-1.2, 0.2, 0.1)};
    for (const double nu : {-0.5, 0.0, 0.3}) {
        const std::vector<Vec3d> moved = posedBy(cage, points, posed, {nu, Rotations::local, 0, 0});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3d expected = identity(
                cage, points[i], nu, [&](openvdb::Index32 k) { return posed[k]; },
                [&](const Vec3d& n, const openvdb::Vec3I&) {
                    double mean = 0; // of the two stretches in the face
                    for (int a = 0; a < 3; ++a) mean += 0.5 * stretch[a] * (1 - n[a] * n[a]);
                    return 2 * (1 + nu) / (1 - 2 * nu) * mean * n;
                });
            BOOST_TEST((moved[i] - expected).length() < 1e-8, "nu " << nu << " point " << i);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_integrals_of_the_matrices)
{
    const Mesh cage = randomCage(Kind::triangles, 64);
    const double size = test::longestSide(cage);
    const openvdb::Vec3I t = cage.triangles[7];
    const auto &a = cage.points[t[0]], &b = cage.points[t[1]], &c = cage.points[t[2]];
    std::vector<Vec3d> points{Vec3d(0), Vec3d(0.3, 0.2, -0.1)};
    for (const double distance : {1e-1, 1e-2, 1e-3}) { // from a face, an edge, a corner
        points.push_back((1 - distance) * (0.3 * a + 0.3 * b + 0.4 * c));
        points.push_back((1 - distance) * (0.3 * a + 0.7 * b));
        points.push_back((1 - distance) * c);
    }
    points.push_back(0.5 * (1.7 * a - 0.7 * b)); // near an edge's line
    const std::vector<double> rows = computeCoordinates(cage, points, Coordinates::somigliana);
    const std::size_t columns = rows.size() / points.size();
    BOOST_REQUIRE(columns == cage.points.size() + 6 * cage.triangles.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        double most = 0;
        for (std::size_t face = 0; face < cage.triangles.size(); ++face) {
            const openvdb::Vec3I f = cage.triangles[face];
            Triangle triangle;
            for (int k = 0; k < 3; ++k) triangle.corners[std::size_t(k)] = cage.points[f[k]];
            const Vec3d first = (triangle.corners[1] - triangle.corners[0]).unit();
            const Vec3d normal = first.cross(triangle.corners[2] - triangle.corners[0]).unit();
            const std::array<Vec3d, 3> frame{normal, first, normal.cross(first)};
            std::array<double, 6> expected{};
            sample(triangle, points[i], [&](const Vec3d& y, const Vec3d&, double area) {
                const Vec3d r = y - points[i];
                const double weight = area / (4 * pi * std::pow(r.length(), 3) * size);
                std::size_t at = 0;
                for (std::size_t p = 0; p < 3; ++p) {
                    for (std::size_t q = p; q < 3; ++q) {
                        expected[at++] += weight * r.dot(frame[p]) * r.dot(frame[q]);
                    }
                }
            });
            for (std::size_t k = 0; k < 6; ++k) {
                const double computed = rows[i * columns + cage.points.size() + 6 * face + k];
                most = std::max(most, std::abs(computed - expected[k]));
            }
        }
        BOOST_TEST(most < 1e-9, "point " << i << " is off by " << most);
    }
}

BOOST_AUTO_TEST_CASE(similarities_are_kept)
{
    for (const Kind kind : test::kinds) {
        const Mesh cage = test::cageFor(Coordinates::somigliana, randomCage(kind, 65));
        const std::vector<Vec3d> points = test::pointsInside(cage, 65);
        const Mat3d turn = rotation(65);
        const auto similarly = [&](const Vec3d& p) { return 1.7 * (turn * p) + Vec3d(3, -2, 1); };
        const auto affinely = [&](const Vec3d& p) { return Vec3d(1.5 * p.x(), p.y(), p.z()); };
        for (const Elasticity& material : materials) {
            const std::vector<Vec3d> same = posedBy(cage, points, mapped(cage.points, similarly), material);
            BOOST_TEST(farthest(same, mapped(points, similarly)) < 1e-10);
            const std::vector<Vec3d> other = posedBy(cage, points, mapped(cage.points, affinely), material);
            BOOST_TEST(farthest(other, mapped(points, affinely)) > 1e-3);
        }
    }
}

// What a pose is does not depend on where it is, how it is turned, and how large.
BOOST_AUTO_TEST_CASE(a_similarity_of_the_pose_moves_the_model_along)
{
    const Mesh cage = randomCage(Kind::triangles, 66);
    const std::vector<Vec3d> points = test::pointsInside(cage, 66), posed = jittered(cage.points, 66, 0.3);
    const Mat3d turn = rotation(66);
    const auto similarly = [&](const Vec3d& p) { return 0.4 * (turn * p) + Vec3d(-3, 2, 1); };
    for (const Elasticity& material : materials) {
        const std::vector<Vec3d> moved = posedBy(cage, points, posed, material);
        const std::vector<Vec3d> other = posedBy(cage, points, mapped(posed, similarly), material);
        BOOST_TEST(farthest(other, mapped(moved, similarly)) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(limits_on_the_cage)
{
    const Mesh cage = randomCage(Kind::triangles, 67);
    const openvdb::Vec3I t = cage.triangles[3];
    const auto &a = cage.points[t[0]], &b = cage.points[t[1]], &c = cage.points[t[2]];
    const std::vector<Vec3d> points{0.3 * a + 0.3 * b + 0.4 * c, 0.3 * a + 0.7 * b, c};
    const std::vector<double> on = computeCoordinates(cage, points, Coordinates::somigliana);
    const std::vector<double> inside = computeCoordinates(
        cage, mapped(points, [](const Vec3d& x) { return (1 - 1e-9) * x; }), Coordinates::somigliana);
    double most = 0;
    for (std::size_t i = 0; i < on.size(); ++i) most = std::max(most, std::abs(on[i] - inside[i]));
    BOOST_TEST(most < 1e-7);
}

BOOST_AUTO_TEST_CASE(smooth_across_the_planes_of_faces)
{
    Mesh cage = test::torus(3, 1, 12, 6);
    cage = {cage.points, triangulate(cage), {}};
    const std::vector<Vec3d> posed = jittered(cage.points, 68, 0.5);
    constexpr double step = 1e-4;
    int crossed = 0;
    Random random(68);
    for (int i = 0; i < 200; ++i) {
        const double around = random(0, 2 * pi);
        Vec3d place = 3.0 * Vec3d(std::cos(around), std::sin(around), 0) + random(0, 0.5) * random.direction();
        const openvdb::Vec3I t = cage.triangles[std::size_t(i) % cage.triangles.size()];
        const Vec3d& a = cage.points[t[0]];
        const Vec3d normal = (cage.points[t[1]] - a).cross(cage.points[t[2]] - a).unit();
        place -= normal.dot(place - a) * normal; // on the plane of a face that is elsewhere
        const double ring = std::hypot(place.x(), place.y()) - 3;
        if (std::hypot(ring, place.z()) > 0.5) continue;
        ++crossed;
        const std::vector<Vec3d> points{place - 2 * step * normal, place - step * normal, place + step * normal,
                                        place + 2 * step * normal};
        const std::vector<Vec3d> moved = posedBy(cage, points, posed, {});
        const Vec3d before = (moved[1] - moved[0]) / step, behind = (moved[3] - moved[2]) / step;
        BOOST_TEST((before - behind).length() < 0.01);
        BOOST_TEST((moved[2] - moved[1]).length() < 4 * step);
    }
    BOOST_TEST(crossed > 5);
}

BOOST_AUTO_TEST_CASE(quads_are_two_triangles)
{
    const Mesh cage = randomCage(Kind::both, 69, 0.05);
    const Mesh split = test::cageFor(Coordinates::somigliana, cage);
    const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.3, 0.4, -0.2)}, posed = jittered(cage.points, 69, 0.3);
    BOOST_TEST((computeCoordinates(cage, points, Coordinates::somigliana) ==
                computeCoordinates(split, points, Coordinates::somigliana)));
    BOOST_TEST((posedBy(cage, points, posed, {}) == posedBy(split, points, posed, {})));
}

// What bending costs in volume: the cage itself loses as much as the families that follow it.
BOOST_AUTO_TEST_CASE(a_bend_keeps_volume_and_shape)
{
    const Mesh cage = bar(12), model = bar(40, 0.6, 3.4);
    const std::vector<Vec3d> posed = mapped(cage.points, bent);
    const auto distortion = [&](const CoordinateOptions& options) {
        return poseDistortion(model, Binding(cage, model.points, options).pose(posed));
    };
    const auto loss = [](const Distortion& d) { return std::abs(1 - *d.volume); };
    const Distortion elastic = distortion(Coordinates::somigliana);
    for (const Coordinates other : {Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood}) {
        const Distortion d = distortion(other);
        BOOST_TEST_MESSAGE(coordinatesName(other) << " " << d.mean << " volume " << *d.volume << "; elastic "
                                                  << elastic.mean << " volume " << *elastic.volume);
        BOOST_TEST(loss(elastic) < loss(d));
        BOOST_TEST(elastic.mean < d.mean);
    }
}

BOOST_AUTO_TEST_CASE(local_rotations_are_for_large_turns)
{
    const Mesh cage = bar(24), model = bar(40, 0.5, 3.6);
    const auto twisted = [](const Vec3d& p) { // by a turn along the bar
        const double angle = 0.5 * pi * p.x();
        return Vec3d(p.x(), p.y() * std::cos(angle) - p.z() * std::sin(angle),
                     p.y() * std::sin(angle) + p.z() * std::cos(angle));
    };
    const std::vector<Vec3d> posed = mapped(cage.points, twisted);
    const Binding binding(cage, model.points, Coordinates::somigliana);
    const Distortion whole = poseDistortion(model, binding.pose(posed));
    const Distortion local = poseDistortion(model, binding.with({0, Rotations::local, 0, 0}).pose(posed));
    const Distortion green = poseDistortion(model, Binding(cage, model.points, Coordinates::green).pose(posed));
    BOOST_TEST(local.mean - 1 < 0.1 * (whole.mean - 1));
    BOOST_TEST(local.mean < green.mean);
    BOOST_TEST(1 - *local.volume < 0.7 * (1 - *whole.volume));
    BOOST_TEST(1 - *local.volume < 0.7 * (1 - *green.volume));
}

BOOST_AUTO_TEST_CASE(bulging)
{
    const Mesh cage = test::sphere(Vec3d(0), 1, 12);
    const std::vector<Vec3d> top{Vec3d(0, 0, 0.8)};
    const Binding binding(cage, top, Coordinates::somigliana);
    const auto heightOf = [&](const std::vector<Vec3d>& posed, const Elasticity& material) {
        return binding.with(material).pose(posed).front().z();
    };
    const auto raised = mapped(cage.points, [](Vec3d p) { // outward, and more curved
        if (p.z() > 0) p.z() += 0.4 * p.z() * p.z();
        return p;
    });
    const auto dented = mapped(cage.points, [](Vec3d p) {
        if (p.z() > 0) p.z() -= 0.4 * p.z() * p.z();
        return p;
    });
    for (const Rotations rotations : {Rotations::global, Rotations::local}) {
        for (const bool isLocal : {false, true}) {
            const Elasticity none{0, rotations, 0, 0}, some{0, rotations, isLocal ? 20.0 : 0, isLocal ? 0 : 20.0};
            BOOST_TEST(heightOf(raised, some) > heightOf(raised, none) + 1e-3);
            BOOST_TEST(heightOf(dented, some) < heightOf(dented, none) - 1e-3);
        }
    }
}

// On a pose that is symmetric, whose tractions are in balance by themselves.
BOOST_AUTO_TEST_CASE(what_bulging_is_measured_by)
{
    const auto octahedron = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        Mesh mesh;
        mesh.points = {a, b, c, -a, -b, -c};
        mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
        return mesh;
    };
    const Mesh cage = octahedron(Vec3d(1, 0.2, 0), Vec3d(-0.1, 0.8, 0.1), Vec3d(0.1, 0, 1.2));
    const std::vector<Vec3d> posed =
        octahedron(Vec3d(0.9, 0.5, 0.1), Vec3d(-0.6, 1.3, 0.1), Vec3d(0.1, 0.3, 0.7)).points;
    const double scale = std::cbrt(volumeOf(cage, posed) / volumeOf(cage, cage.points)), amount = 2;
    const Mat3d turn = fitted(cage, posed);
    const std::vector<Pull> none = pullsOf(cage, posed, {0, Rotations::local, 0, 0});
    const std::vector<Pull> curved = pullsOf(cage, posed, {0, Rotations::local, amount, 0});
    const std::vector<Pull> moved = pullsOf(cage, posed, {0, Rotations::local, 0, amount});
    const auto normalsOf = [&](const std::vector<Vec3d>& points) {
        std::vector<Vec3d> normals(points.size(), Vec3d(0));
        for (const openvdb::Vec3I& t : cage.triangles) {
            const Vec3d n = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
            for (int k = 0; k < 3; ++k) normals[t[k]] += n;
        }
        return normals;
    };
    const auto solidAngle = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) { // by the angles of its sides
        const auto corner = [](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
            const Vec3d u = p.cross(q), v = p.cross(r);
            return std::atan2(u.cross(v).length(), u.dot(v));
        };
        const double excess = corner(a, b, c) + corner(b, c, a) + corner(c, a, b) - pi;
        return a.dot(b.cross(c)) < 0 ? -excess : excess;
    };
    const std::vector<Vec3d> before = normalsOf(cage.points), after = normalsOf(posed);
    double most = 0;
    for (std::size_t face = 0; face < cage.triangles.size(); ++face) {
        const openvdb::Vec3I t = cage.triangles[face];
        BOOST_TEST(std::abs(none[face].traction - 2 * none[face].stretch) < 1e-9);
        const double spread =
            solidAngle(after[t[0]], after[t[1]], after[t[2]]) - solidAngle(before[t[0]], before[t[1]], before[t[2]]);
        BOOST_TEST(std::abs(std::log(curved[face].traction / none[face].traction) - amount * spread / (4 * pi)) < 1e-9);
        double swept = 0; // by steps in time
        constexpr int steps = 200;
        for (int step = 0; step < steps; ++step) {
            const double time = (step + 0.5) / steps;
            Vec3d at[3], motion(0);
            for (int k = 0; k < 3; ++k) {
                const Vec3d from = scale * (turn * cage.points[t[k]]);
                at[k] = (1 - time) * from + time * posed[t[k]];
                motion += (posed[t[k]] - from) / 3;
            }
            swept += motion.dot((at[1] - at[0]).cross(at[2] - at[0])) / 2 / steps;
        }
        const double expected = amount * swept / volumeOf(cage, posed);
        BOOST_TEST(std::abs(std::log(moved[face].traction / none[face].traction) - expected) < 1e-5);
        most = std::max(most, std::abs(expected));
    }
    BOOST_TEST(most > 0.05);
}

BOOST_AUTO_TEST_CASE(tractions_are_no_force)
{
    const Mesh cage = randomCage(Kind::triangles, 73);
    const std::vector<Vec3d> posed = jittered(cage.points, 73, 0.4);
    for (const Elasticity& material : materials) {
        if (material.rotations == Rotations::global) continue;
        Vec3d force(0);
        double size = 0;
        const std::vector<Pull> pulls = pullsOf(cage, posed, material);
        for (std::size_t face = 0; face < pulls.size(); ++face) {
            const openvdb::Vec3I t = cage.triangles[face];
            const Vec3d& a = cage.points[t[0]];
            const double area = (cage.points[t[1]] - a).cross(cage.points[t[2]] - a).length();
            force += area * pulls[face].traction * pulls[face].normal;
            size += area * std::abs(pulls[face].traction);
        }
        BOOST_TEST(force.length() < 1e-12 * size);
    }
}

BOOST_AUTO_TEST_CASE(slivers_change_nothing)
{
    Mesh cage = randomCage(Kind::triangles, 74);
    const std::vector<Vec3d> points = test::pointsInside(cage, 74);
    std::vector<Vec3d> posed = jittered(cage.points, 74, 0.3);
    const Elasticity material{0.2, Rotations::local, 0, 0};
    const std::vector<Vec3d> expected = posedBy(cage, points, posed, material);
    const openvdb::Vec3I t = cage.triangles[4];
    cage = test::withSliver(cage, 0);
    posed.push_back(0.5 * (posed[t[0]] + posed[t[1]]));
    BOOST_TEST(farthest(posedBy(cage, points, posed, material), expected) < 1e-7);
}

BOOST_AUTO_TEST_CASE(poses_that_have_no_volume)
{
    const Mesh cage = randomCage(Kind::triangles, 70);
    const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.3, 0.4, -0.2)};
    const Binding binding(cage, points, Coordinates::somigliana);
    std::vector<std::vector<Vec3d>> poses;
    poses.push_back(mapped(cage.points, [](const Vec3d& p) { return Vec3d(p.x(), p.y(), 0); }));
    poses.push_back(mapped(cage.points, [](const Vec3d& p) { return Vec3d(p.x(), 0, 0); }));
    poses.push_back(mapped(cage.points, [](const Vec3d&) { return Vec3d(1, 2, 3); }));
    poses.push_back(mapped(cage.points, [](const Vec3d& p) { return Vec3d(-p.x(), p.y(), p.z()); }));
    for (const Elasticity& material : materials) {
        for (const std::vector<Vec3d>& posed : poses) {
            for (const Vec3d& p : binding.with(material).pose(posed)) {
                BOOST_TEST((std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())));
                BOOST_TEST(p.length() < 10);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(another_material_needs_no_other_weights)
{
    const Mesh cage = randomCage(Kind::triangles, 71);
    const std::vector<Vec3d> points = test::pointsInside(cage, 71), posed = jittered(cage.points, 71, 0.3);
    const Binding binding(cage, points, Coordinates::somigliana);
    for (const Elasticity& material : materials) {
        const Binding other = binding.with(material);
        BOOST_TEST((other.options().elasticity == material));
        BOOST_TEST((other.pose(cage.points) == points));
        BOOST_TEST((other.pose(posed) == Binding(cage, points, {Coordinates::somigliana, material}).pose(posed)));
        BOOST_TEST(farthest(other.pose(posed), posedBy(cage, points, posed, material)) < 1e-5);
        if (material != Elasticity()) BOOST_TEST(farthest(other.pose(posed), binding.pose(posed)) > 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(materials_that_there_are_not)
{
    const Mesh cage = randomCage(Kind::triangles, 72);
    const auto messageOf = [&](const Elasticity& material) -> std::string {
        try {
            cageHandles(cage, cage.points, {Coordinates::somigliana, material});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    BOOST_TEST(messageOf({0.5, Rotations::global, 0, 0}) ==
               "nu: 0.5 is not allowed; it must be above -1 and below 0.5");
    BOOST_TEST(messageOf({-1, Rotations::global, 0, 0}) == "nu: -1 is not allowed; it must be above -1 and below 0.5");
    BOOST_TEST(messageOf({std::nan(""), Rotations::global, 0, 0}).find("nu: ") == 0U);
    BOOST_TEST(messageOf({0, Rotations::global, -1, 0}) == "local bulging: -1 is not allowed; it must be 0 to 100");
    BOOST_TEST(messageOf({0, Rotations::global, 0, 101}) == "global bulging: 101 is not allowed; it must be 0 to 100");
    BOOST_TEST(messageOf({0.499, Rotations::local, 100, 100}).empty());
    const Binding binding(cage, {Vec3d(0)}, Coordinates::somigliana);
    BOOST_CHECK_THROW(binding.with({2, Rotations::global, 0, 0}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
