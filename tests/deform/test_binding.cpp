#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <deform/cages.h>
#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/weight_blocks.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::cageFor;
using test::jittered;
using test::Kind;
using test::mapped;
using test::pointsInside;
using test::Random;
using test::randomCage;

namespace {

const std::vector<Coordinates> families = test::exactFamilies();

double difference(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    BOOST_REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).length());
    return most;
}

/// A bar along x, from -2 to 2 and 1 wide, of `pieces` rings of quads.
Mesh bar(int pieces)
{
    Mesh mesh;
    for (int i = 0; i <= pieces; ++i) {
        for (int k = 0; k < 4; ++k) {
            mesh.points.emplace_back(-2 + 4.0 * i / pieces, k == 1 || k == 2 ? 0.5 : -0.5, k > 1 ? 0.5 : -0.5);
        }
    }
    const auto at = [](int i, int k) { return static_cast<openvdb::Index32>(4 * i + k % 4); };
    for (int i = 0; i < pieces; ++i) {
        for (int k = 0; k < 4; ++k) {
            mesh.quads.emplace_back(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
        }
    }
    mesh.quads.emplace_back(at(0, 3), at(0, 2), at(0, 1), at(0, 0));
    mesh.quads.emplace_back(at(pieces, 0), at(pieces, 1), at(pieces, 2), at(pieces, 3));
    return mesh;
}

Vec3d bent(const Vec3d& p) // by a quarter turn over the middle half
{
    const double angle = std::clamp(p.x(), -1.0, 1.0) * detail::pi / 4;
    const double radius = 4 / detail::pi, over = p.x() - std::clamp(p.x(), -1.0, 1.0);
    return {(radius - p.y()) * std::sin(angle) + over * std::cos(angle),
            radius - (radius - p.y()) * std::cos(angle) + over * std::sin(angle), p.z()};
}

Vec3d twisted(const Vec3d& p) // by a quarter turn along the bar
{
    const double angle = p.x() * detail::pi / 8;
    return {p.x(), p.y() * std::cos(angle) - p.z() * std::sin(angle),
            p.y() * std::sin(angle) + p.z() * std::cos(angle)};
}

struct Distortion {
    double mean, percentile95;
};

/// How far the deformation that moves the cage's points by `map` is from a similarity at `places`, which are at least
/// 2e-3 inside: the logarithm of the largest over the least principal stretch.
template <typename Map>
Distortion distortion(const Mesh& cage, const std::vector<Vec3d>& places, Coordinates family, const Map& map)
{
    constexpr double step = 1e-3;
    std::vector<Vec3d> points;
    for (const Vec3d& p : places) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-step, step}) {
                points.push_back(p);
                points.back()[axis] += side;
            }
        }
    }
    const std::vector<Vec3d> posedCage = mapped(cage.points, map);
    const std::vector<double> coordinates = computeCoordinates(cage, points, family);
    const std::vector<Vec3d> handles = cageHandles(cage, posedCage, family);
    double sum = 0;
    std::vector<double> all;
    for (std::size_t i = 0; i < points.size(); i += 6) {
        double gram[3][3];
        Vec3d gradient[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            gradient[axis] = (test::weighted(coordinates, i + 2 * axis + 1, handles) -
                              test::weighted(coordinates, i + 2 * axis, handles)) /
                             (2 * step);
        }
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) gram[r][c] = gradient[r].dot(gradient[c]);
        }
        for (int sweep = 0; sweep < 20; ++sweep) { // Jacobi's method for its eigenvalues
            for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
                const double angle = 0.5 * std::atan2(2 * gram[p][q], gram[q][q] - gram[p][p]);
                const double c = std::cos(angle), s = std::sin(angle);
                for (auto& row : gram) {
                    const double a = row[p], b = row[q];
                    row[p] = c * a - s * b;
                    row[q] = s * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    const double a = gram[p][k], b = gram[q][k];
                    gram[p][k] = c * a - s * b;
                    gram[q][k] = s * a + c * b;
                }
            }
        }
        const auto [least, most] = std::minmax({gram[0][0], gram[1][1], gram[2][2]});
        all.push_back(0.5 * std::log(most / least));
        sum += all.back();
    }
    std::sort(all.begin(), all.end());
    return {sum / double(all.size()), all[all.size() * 95 / 100]};
}

/// Many points in front of a few places of the cage, near and far, some of them twice.
std::vector<Vec3d> closePoints(const Mesh& cage, std::uint32_t seed)
{
    Random random(seed);
    std::vector<Vec3d> points;
    for (const double depth : {1e-9, 1e-3, 0.05, 0.5, 0.95}) {
        std::vector<Vec3d> corners; // of a triangle or quad, the last twice
        const auto face = static_cast<std::size_t>(1000 * depth) * 7;
        for (int k = 0; k < 4; ++k) {
            corners.push_back(cage.points[!cage.quads.empty() && (face % 2 == 0 || cage.triangles.empty())
                                              ? cage.quads[face % cage.quads.size()][k]
                                              : cage.triangles[face % cage.triangles.size()][std::min(k, 2)]]);
        }
        for (int i = 0; i < 150; ++i) {
            const double u = random(0.2, 0.6), v = random(0.1, 0.5);
            const Vec3d low = (1 - u) * corners[0] + u * corners[1], high = (1 - u) * corners[3] + u * corners[2];
            points.push_back((1 - depth) * ((1 - v) * low + v * high));
        }
    }
    const std::vector<Vec3d> some(points.begin(), points.begin() + 40);
    points.insert(points.end(), some.begin(), some.end());
    return points;
}

/// The sums of rows' absolute values, of normals' times the square of their edges' mean in units of the cage, of
/// Somigliana's matrices four times.
std::vector<double> sizesOf(const std::vector<double>& coordinates, const Mesh& cage, Coordinates family)
{
    openvdb::BBoxd box;
    for (const Vec3d& p : cage.points) box.expand(p);
    const double size = box.extents()[int(box.maxExtent())];
    std::vector<double> reach(cage.points.size(), 1.0);
    if (family == Coordinates::green) {
        const auto add = [&](openvdb::Index32 corner, openvdb::Index32 next, openvdb::Index32 before) {
            const Vec3d &at = cage.points[corner], &a = cage.points[next], &b = cage.points[before];
            reach.push_back(std::pow(0.5 * ((a - at).length() + (b - at).length()) / size, 2));
        };
        for (const openvdb::Vec3I& t : cage.triangles) add(t[0], t[1], t[2]);
        for (const openvdb::Vec4I& q : cage.quads) {
            for (int k = 0; k < 4; ++k) add(q[k], q[(k + 1) % 4], q[(k + 3) % 4]);
        }
    }
    if (family == Coordinates::somigliana) {
        reach.resize(cageHandles(cage, cage.points, family).size(), 4.0);
    }
    std::vector<double> sizes;
    for (std::size_t i = 0; i < coordinates.size(); i += reach.size()) {
        sizes.push_back(0);
        for (std::size_t k = 0; k < reach.size(); ++k) sizes.back() += reach[k] * std::abs(coordinates[i + k]);
    }
    return sizes;
}

} // namespace

BOOST_AUTO_TEST_SUITE(binding)

BOOST_AUTO_TEST_CASE(poses_as_the_coordinates_say)
{
    for (const Coordinates family : families) {
        const Mesh cage = cageFor(family, randomCage(Kind::both, 20));
        const std::vector<Vec3d> points = pointsInside(cage, 20, 50); // not a whole number of groups
        const Binding bound(cage, points, family);
        BOOST_TEST(bound.points().size() == points.size());
        BOOST_TEST((bound.pose(cage.points) == points)); // bit by bit
        const std::vector<Vec3d> posedCage = jittered(cage.points, 1);
        const std::vector<double> coordinates = computeCoordinates(cage, points, family);
        const std::vector<Vec3d> handles = cageHandles(cage, posedCage, family);
        BOOST_TEST(bound.handles() == handles.size());
        std::vector<Vec3d> expected;
        for (std::size_t i = 0; i < points.size(); ++i) expected.push_back(test::weighted(coordinates, i, handles));
        const std::vector<Vec3d> posed = bound.pose(posedCage);
        BOOST_TEST(difference(posed, expected) < 1e-6);
        BOOST_TEST(difference(posed, points) > 0.02);

        const std::vector<float> weights = computeWeights(cage, points, family);
        BOOST_REQUIRE(weights.size() == coordinates.size());
        std::size_t off = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) off += weights[i] != static_cast<float>(coordinates[i]);
        BOOST_TEST(off == 0U);
        BOOST_TEST((Binding(cage, points, family, weights).pose(posedCage) == posed));
        BOOST_CHECK_THROW(Binding(cage, points, family, {1.0F}), InputError);
        std::vector<Vec3d> nowhere = points;
        nowhere[7].y() = std::nan("");
        BOOST_CHECK_THROW(Binding(cage, nowhere, family, weights), InputError);
    }
}

BOOST_AUTO_TEST_CASE(combinations_are_within_their_bound)
{
    for (const Kind kind : test::kinds) {
        for (const Coordinates family : families) {
            const Mesh cage = cageFor(family, randomCage(kind, 24, 0.1, 2));
            const std::vector<Vec3d> points = closePoints(cage, 25);
            const Binding bound(cage, points, family);
            BOOST_TEST(bound.weightBytes() < 3 * points.size() * bound.handles()); // there are combinations
            BOOST_TEST((bound.pose(cage.points) == points));
            const std::vector<double> coordinates = computeCoordinates(cage, points, family);
            const std::vector<double> sizes = sizesOf(coordinates, cage, family);
            const auto offBy = [&](const std::vector<Vec3d>& posedCage) { // relative to the bound
                const std::vector<Vec3d> handles = cageHandles(cage, posedCage, family);
                const std::vector<Vec3d> posed = bound.pose(posedCage);
                std::vector<double> off;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    off.push_back((posed[i] - test::weighted(coordinates, i, handles)).length() / sizes[i]);
                }
                return off;
            };
            const std::vector<Vec3d> jitter = jittered(cage.points, 26, 0.1);
            const std::vector<double> off = offBy(jitter);
            BOOST_TEST(*std::max_element(off.begin(), off.end()) < 1e-7);
            std::vector<Vec3d> updated = bound.pose(jittered(cage.points, 27, 0.1));
            bound.update(updated, jittered(cage.points, 27, 0.1), jitter);
            BOOST_TEST(difference(updated, bound.pose(jitter)) < 1e-7);
            if (family == Coordinates::somigliana) continue; // each point moves handles of all faces: see below
            // Point by point of the cage: what the moves add up to if all signs are the worst.
            std::vector<double> sums(points.size(), 0.0);
            for (std::size_t k = 0; k < cage.points.size(); ++k) {
                std::vector<Vec3d> posedCage = cage.points;
                posedCage[k].x() += 0.01;
                const std::vector<double> offOfOne = offBy(posedCage);
                for (std::size_t i = 0; i < points.size(); ++i) sums[i] += offOfOne[i] / 0.01;
            }
            BOOST_TEST(*std::max_element(sums.begin(), sums.end()) < 1e-6);
        }
    }
}

// What the handles add up to if all go as far as the bound allows, with the worst signs.
BOOST_AUTO_TEST_CASE(somigliana_at_the_border_of_its_bound)
{
    const Mesh cage = randomCage(Kind::triangles, 28, 0.1, 2);
    const double size = test::longestSide(cage);
    const std::vector<Vec3d> points = closePoints(cage, 28);
    const std::vector<double> coordinates = computeCoordinates(cage, points, Coordinates::somigliana);
    const std::vector<double> sizes = sizesOf(coordinates, cage, Coordinates::somigliana);
    const std::size_t handles = handleCount(cage, Coordinates::somigliana);
    std::vector<float> farthest(cage.points.size(), 1);
    farthest.resize(handles, 4);
    const detail::WeightBlocks blocks(
        points, farthest, [&](const std::vector<std::uint32_t>& block, std::vector<float>& rows) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                rows[i] = static_cast<float>(coordinates[block[i / handles] * handles + i % handles]);
            }
        });
    std::vector<double> sums(points.size(), 0.0);
    for (std::size_t k = 0; k < handles; ++k) {
        std::vector<Vec3d> moved(points.size(), Vec3d(0));
        blocks.move({{k, openvdb::Vec3f(1, 0, 0)}}, 1, moved);
        for (std::size_t i = 0; i < points.size(); ++i) {
            sums[i] += farthest[k] * std::abs(moved[i].x() - coordinates[i * handles + k]) / sizes[i];
        }
    }
    BOOST_TEST(*std::max_element(sums.begin(), sums.end()) < 1e-6);

    // They go no farther where all triangles get twice as wide, or by as much more as the material says.
    const std::vector<Vec3d> posed = mapped(cage.points, [](const Vec3d& p) { return 2.0 * p; });
    for (const double nu : {-0.9, 0.0, 0.4, 0.499}) {
        const double growth = std::max(1.0, 1 / (1 - 2 * nu));
        const CoordinateOptions options(Coordinates::somigliana, {nu, Elasticity::Rotations::global, 0, 0});
        const std::vector<Vec3d> before = cageHandles(cage, cage.points, options),
                                 after = cageHandles(cage, posed, options);
        double most = 0;
        for (std::size_t k = cage.points.size(); k < handles; ++k) {
            most = std::max(most, (after[k] - before[k]).length() / size);
        }
        BOOST_TEST(most < (4 + 1e-9) * growth);
        BOOST_TEST(most > 2 * growth);
    }
}

BOOST_AUTO_TEST_CASE(updates_what_moved)
{
    for (const Coordinates family : families) {
        const Mesh cage = cageFor(family, randomCage(Kind::both, 21));
        const std::vector<Vec3d> points = pointsInside(cage, 21, 40);
        const Binding bound(cage, points, family);
        const std::vector<Vec3d> first = jittered(cage.points, 2);
        std::vector<Vec3d> second = first;
        second[4] += Vec3d(0.1, 0.2, -0.1);
        std::vector<Vec3d> posed = bound.pose(first);
        bound.update(posed, first, second);
        BOOST_TEST(difference(posed, bound.pose(second)) < 1e-6);
        bound.update(posed, second, cage.points);
        BOOST_TEST(difference(posed, points) < 1e-6);
        posed.pop_back();
        BOOST_CHECK_THROW(bound.update(posed, first, second), InputError);
        BOOST_CHECK_EXCEPTION(bound.pose({Vec3d(0)}), InputError, [](const InputError& error) {
            return std::string(error.what()) == "posed cage: it has 1 points; the cage has 26";
        });
        second[0].x() = std::nan("");
        BOOST_CHECK_THROW(bound.pose(second), InputError);
    }
}

BOOST_AUTO_TEST_CASE(poses_of_any_size_and_place)
{
    for (const double size : {1e-50, 1e50}) {
        Mesh cage = randomCage(Kind::both, 22);
        std::vector<Vec3d> points = pointsInside(cage, 22), posedCage = jittered(cage.points, 3);
        const std::vector<Vec3d> expected = Binding(cage, points, Coordinates::green).pose(posedCage);
        for (auto* list : {&cage.points, &points, &posedCage}) {
            for (Vec3d& p : *list) p *= size;
        }
        std::vector<Vec3d> posed = Binding(cage, points, Coordinates::green).pose(posedCage);
        for (Vec3d& p : posed) p /= size;
        BOOST_TEST(difference(posed, expected) < 1e-5);
    }
}

BOOST_AUTO_TEST_CASE(same_bytes_for_any_number_of_threads)
{
    const Mesh cage = randomCage(Kind::both, 23, 0.1, 2);
    std::vector<Vec3d> points = pointsInside(cage, 23, 2000);
    const std::vector<Vec3d> close = closePoints(cage, 24), posedCage = jittered(cage.points, 4);
    points.insert(points.end(), close.begin(), close.end());
    const Binding bound(cage, points, Coordinates::green);
    BOOST_TEST(bound.weightBytes() < 4 * points.size() * bound.handles());
    const auto poseAndUpdate = [&](const Binding& binding) {
        std::vector<Vec3d> posed = binding.pose(posedCage);
        binding.update(posed, posedCage, cage.points);
        const std::vector<Vec3d> again = binding.pose(posedCage);
        posed.insert(posed.end(), again.begin(), again.end());
        return posed;
    };
    const std::vector<Vec3d> posed = poseAndUpdate(bound);
    int differ = 0;
    for (int i = 0; i < 50; ++i) differ += poseAndUpdate(bound) != posed; // threads join in at times only
    BOOST_TEST(differ == 0);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST((poseAndUpdate(bound) == posed));
    BOOST_TEST((poseAndUpdate(Binding(cage, points, Coordinates::green)) == posed));
}

BOOST_AUTO_TEST_CASE(green_keeps_shapes)
{
    Random random(1);
    std::vector<Vec3d> places;
    for (int i = 0; i < 200; ++i) places.emplace_back(random(-1.8, 1.8), random(-0.4, 0.4), random(-0.4, 0.4));
    const Mesh quads = bar(8), triangles{quads.points, triangulate(quads), {}};
    for (const Mesh* cage : {&quads, &triangles}) {
        BOOST_TEST(distortion(*cage, places, Coordinates::green, bent).mean <
                   0.8 * distortion(*cage, places, Coordinates::meanValue, bent).mean);
        BOOST_TEST(distortion(*cage, places, Coordinates::green, twisted).mean <
                   distortion(*cage, places, Coordinates::meanValue, twisted).mean);
    }
}

/// The animal bends sideways and twists along its spine, each by about a quarter turn.
BOOST_AUTO_TEST_CASE(green_keeps_the_shape_of_the_creature)
{
    Mesh model = readMesh(std::filesystem::path(VDBCAGE_SOURCE_DIR) / "data/creature.obj");
    // Its spine along x, its left along y, from about -1.7 to 2.
    for (Vec3d& p : model.points) p = Vec3d((p.z() - 10) / 40, p.x() / 40, (p.y() - 60) / 40);
    CageOptions options;
    options.faces = 400;
    const Mesh cage = makeCage(model, options);
    BOOST_TEST(cage.quads.empty());
    std::vector<Vec3d> normals(model.points.size(), Vec3d(0)), places;
    for (const openvdb::Vec3I& t : triangulate(model)) {
        const Vec3d normal = (model.points[t[1]] - model.points[t[0]]).cross(model.points[t[2]] - model.points[t[0]]);
        for (int k = 0; k < 3; ++k) normals[t[k]] += normal;
    }
    for (std::size_t i = 0; i < model.points.size(); i += 23) {
        places.push_back(model.points[i] - 5e-3 / normals[i].length() * normals[i]);
    }
    const auto compare = [&](const char* what, const auto& map) {
        const Distortion green = distortion(cage, places, Coordinates::green, map);
        const Distortion meanValue = distortion(cage, places, Coordinates::meanValue, map);
        BOOST_TEST_MESSAGE(what << ": green " << green.mean << ", 95 % below " << green.percentile95 << "; mean value "
                                << meanValue.mean << ", " << meanValue.percentile95);
        BOOST_TEST(green.mean < 0.8 * meanValue.mean);
        BOOST_TEST(green.percentile95 < 0.8 * meanValue.percentile95);
    };
    compare("bend", bent);
    compare("twist", twisted);
}

BOOST_AUTO_TEST_CASE(can_be_cancelled_at_every_question)
{
    const Mesh cage = randomCage(Kind::both, 15);
    const std::vector<Vec3d> points = pointsInside(cage, 15, 600);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1); // the same questions each time
    test::StopAt never(1000000);
    const Binding all(cage, points, Coordinates::green, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > int(points.size()) + 2); // at each point, and where blocks are split and compressed
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(Binding(cage, points, Coordinates::green, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(sorting_many_points_into_blocks_asks)
{
    Random random(16);
    std::vector<Vec3d> points(300000);
    for (Vec3d& p : points) p = random.direction();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    test::StopAt never(1000000);
    struct Sorted {};
    const auto stopAtFirstRow = [](const std::vector<std::uint32_t>&, std::vector<float>&) { throw Sorted(); };
    BOOST_CHECK_THROW(detail::WeightBlocks(points, {1.0F}, stopAtFirstRow, &never), Sorted);
    const auto blocks = int(points.size() / 256);
    const auto turns = int(points.size() / 65536); // of the first split, at least
    BOOST_TEST(test::questions(never, 1000000) >= blocks + turns);
}

BOOST_AUTO_TEST_SUITE_END()
