#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <deform/cages.h>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/inversions.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::Kind;
using test::mapped;
using test::Random;
using test::randomCage;

namespace {

const std::vector<Coordinates> families = test::exactFamilies();

const Mesh model = test::sphere(Vec3d(0.1, 0, 0), 0.5, 12);

std::vector<std::uint32_t> inverted(const Mesh& cage, const Mesh& mesh, Coordinates family,
                                    const std::vector<Vec3d>& pose)
{
    return invertedTriangles(Binding(cage, mesh.points, family), mesh, {pose}).front();
}

} // namespace

BOOST_AUTO_TEST_SUITE(inversions)

BOOST_AUTO_TEST_CASE(turning_inverts_nothing_mirroring_everything)
{
    const auto turned = [](const Vec3d& p) {
        return Vec3d(-0.6 * p.x() - 0.8 * p.z() + 9, p.y(), 0.8 * p.x() - 0.6 * p.z());
    };
    const auto mirrored = [](const Vec3d& p) { return Vec3d(p.x(), 0.2 * p.x() - p.y(), p.z()); };
    for (const Kind kind : test::kinds) {
        const Mesh cage = randomCage(kind, 40);
        for (const Coordinates family : families) {
            BOOST_TEST(inverted(cage, model, family, cage.points).empty());
            BOOST_TEST(inverted(cage, model, family, mapped(cage.points, turned)).empty());
            if (family == Coordinates::green || family == Coordinates::somigliana) continue; // no mirroring
            BOOST_TEST(inverted(cage, model, family, mapped(cage.points, mirrored)).size() ==
                       triangulate(model).size());
        }
    }
}

/// By the determinant of the deformation's Jacobian, from central differences in double.
BOOST_AUTO_TEST_CASE(agrees_with_the_jacobian)
{
    const Mesh cage = randomCage(Kind::both, 41);
    const Mesh fine = test::sphere(Vec3d(0), 0.6, 40);
    const std::vector<openvdb::Vec3I> triangles = triangulate(fine);
    // One side is pushed through the other, or wrung.
    const auto pushed = [](const Vec3d& p) { return p - Vec3d(2.4 * std::max(0.0, p.x()), 0, 0); };
    const auto wrung = [](const Vec3d& p) {
        const double angle = 3.5 * p.z();
        return Vec3d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                     std::sin(angle) * p.x() + std::cos(angle) * p.y(), p.z());
    };
    constexpr double step = 1e-4;
    constexpr std::size_t every = 11;
    std::vector<Vec3d> around;
    for (std::size_t i = 0; i < triangles.size(); i += every) {
        const openvdb::Vec3I& t = triangles[i];
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-step, step}) {
                around.push_back((fine.points[t[0]] + fine.points[t[1]] + fine.points[t[2]]) / 3);
                around.back()[axis] += side;
            }
        }
    }
    for (const Coordinates family : families) {
        const Binding binding(cage, fine.points, family);
        const std::vector<double> coordinates = computeCoordinates(cage, around, family);
        std::size_t found = 0;
        for (const std::vector<Vec3d>& pose : {mapped(cage.points, pushed), mapped(cage.points, wrung)}) {
            const std::vector<std::uint32_t> result = invertedTriangles(binding, fine, {pose}).front();
            found += result.size();
            BOOST_TEST(std::is_sorted(result.begin(), result.end()));
            const std::vector<Vec3d> handles = cageHandles(cage, pose, family);
            std::size_t sure = 0, wrong = 0;
            for (std::size_t i = 0; i < triangles.size(); i += every) {
                Vec3d columns[3];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::size_t row = 6 * (i / every) + 2 * axis;
                    columns[axis] =
                        test::weighted(coordinates, row + 1, handles) - test::weighted(coordinates, row, handles);
                }
                const double determinant = columns[0].dot(columns[1].cross(columns[2])) / std::pow(2 * step, 3);
                if (std::abs(determinant) < 0.05) continue; // changes sign within the triangle, maybe
                ++sure;
                if (std::binary_search(result.begin(), result.end(), i) != (determinant < 0)) ++wrong;
            }
            BOOST_TEST(wrong == 0U);
            BOOST_TEST(sure > triangles.size() / every / 2);
        }
        BOOST_TEST(found > triangles.size() / 20);
        BOOST_TEST(found < triangles.size());
    }
}

BOOST_AUTO_TEST_CASE(every_pose_by_itself_for_any_number_of_threads)
{
    const Mesh cage = randomCage(Kind::triangles, 42);
    const Binding binding(cage, model.points, Coordinates::meanValue);
    const auto mirrored = mapped(cage.points, [](const Vec3d& p) { return Vec3d(p.x(), p.y(), -p.z()); });
    const auto crumpled =
        mapped(cage.points, [](const Vec3d& p) { return p - Vec3d(2.4 * std::max(0.0, p.x()), 0, 0); });
    const auto together = invertedTriangles(binding, model, {cage.points, mirrored, crumpled});
    BOOST_REQUIRE(together.size() == 3U);
    BOOST_TEST(together[0].empty());
    BOOST_TEST(together[1].size() == triangulate(model).size());
    BOOST_TEST((together[2] == invertedTriangles(binding, model, {crumpled}).front()));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST((together == invertedTriangles(binding, model, {cage.points, mirrored, crumpled})));
    BOOST_TEST(invertedTriangles(binding, model, {}).empty());
}

BOOST_AUTO_TEST_CASE(the_test_that_is_kept_finds_the_same)
{
    const auto crumpled = [](const Vec3d& p) { return p - Vec3d(2.4 * std::max(0.0, p.x()), 0, 0); };
    const auto mirrored = [](const Vec3d& p) { return Vec3d(p.x(), p.y(), -p.z()); };
    for (const Coordinates family : families) {
        std::optional<InversionTest> kept;
        std::vector<std::vector<Vec3d>> poses;
        const Elasticity bulging{0.4, Elasticity::Rotations::local, 3, 5};
        std::vector<std::vector<std::uint32_t>> expected, expectedBulging;
        {
            const Mesh cage = randomCage(Kind::both, 43), mesh = test::sphere(Vec3d(0.1, 0, 0), 0.5, 12);
            const Binding binding(cage, mesh.points, family);
            poses = {cage.points, mapped(cage.points, crumpled), mapped(cage.points, mirrored), cage.points};
            Random random(44);
            for (Vec3d& p : poses.back()) p += random(0, 1.5) * random.direction();
            expected = invertedTriangles(binding, mesh, poses);
            expectedBulging = invertedTriangles(binding.with(bulging), mesh, poses);
            kept.emplace(binding, mesh);
        } // it outlives what it was made from
        const InversionTest copy = *kept;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            BOOST_TEST((kept->inverted(poses[i]) == expected[i]));
            BOOST_TEST((copy.inverted(poses[i]) == expected[i]));
        }
        const InversionTest other = kept->with(bulging);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            BOOST_TEST((other.inverted(poses[i]) == expectedBulging[i]));
            BOOST_TEST((other.with(Elasticity()).inverted(poses[i]) == expected[i]));
        }
        BOOST_TEST((expectedBulging != expected) == familyInfo(family).hasElasticity);
        if (familyInfo(family).hasElasticity) {
            BOOST_CHECK_THROW(kept->with({0.5, Elasticity::Rotations::global, 0, 0}), InputError);
        }
        BOOST_TEST(expected[0].empty());
        BOOST_TEST(!expected[1].empty());
        BOOST_TEST(expected[1] != expected[2]);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        BOOST_TEST((kept->inverted(poses[3]) == expected[3]));
        BOOST_CHECK_THROW(kept->inverted({Vec3d(0)}), InputError);
        poses[1][0].x() = std::nan("");
        BOOST_CHECK_THROW(kept->inverted(poses[1]), InputError);
    }
}

BOOST_AUTO_TEST_CASE(more_triangles_than_a_piece_and_ones_without_a_side)
{
    const Mesh box = test::box(Vec3d(-1), Vec3d(1)), cage{box.points, triangulate(box), {}};
    const Mesh many = test::sphere(Vec3d(0), 0.6, 100); // 39600 triangles
    const auto mirrored = mapped(cage.points, [](const Vec3d& p) { return Vec3d(-p.x(), p.y(), p.z()); });
    const auto all = inverted(cage, many, Coordinates::meanValue, mirrored);
    BOOST_REQUIRE(all.size() == triangulate(many).size());
    BOOST_TEST(all.back() == all.size() - 1);
    BOOST_TEST((InversionTest(Binding(cage, many.points, Coordinates::meanValue), many).inverted(mirrored) == all));
    Mesh odd{
        {Vec3d(0), Vec3d(0.5, 0, 0), Vec3d(0, 0.5, 0), Vec3d(0.5, 1e-8, 0)}, {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}}, {}};
    BOOST_TEST((inverted(cage, odd, Coordinates::meanValue, mirrored) == std::vector<std::uint32_t>{0}));
}

BOOST_AUTO_TEST_CASE(wrong_pairs)
{
    const Mesh cage = test::box(Vec3d(-1), Vec3d(1));
    const Binding binding(cage, model.points, Coordinates::green);
    BOOST_CHECK_EXCEPTION(invertedTriangles(binding, cage, {cage.points}), InputError, [&](const InputError& error) {
        return std::string(error.what()) ==
               "model: it has 8 points; the binding has " + std::to_string(model.points.size());
    });
    BOOST_CHECK_THROW(invertedTriangles(binding, model, {{Vec3d(0)}}), InputError);
    BOOST_CHECK_THROW(InversionTest(binding, cage), InputError);
    const std::vector<float> weights = computeWeights(cage, model.points, Coordinates::meanValue);
    const Binding given(cage, model.points, Coordinates::given, weights);
    const auto isClear = [](const InputError& error) {
        return std::string(error.what()) ==
               "inversions: the binding's weights were made elsewhere; two points are looked at for each triangle, "
               "which needs coordinates that can be computed at other points";
    };
    BOOST_CHECK_EXCEPTION(invertedTriangles(given, model, {}), InputError, isClear);
    BOOST_CHECK_EXCEPTION(InversionTest(given, model), InputError, isClear);
    // A triangle across the notch of a cage: its corners are inside, its middle is not.
    Mesh notched = cage;
    for (Vec3d& p : notched.points) {
        if (p.x() > 0 && p.y() > 0) p = Vec3d(-0.8, -0.8, p.z());
    }
    const Mesh across{{Vec3d(0.3, -0.97, 0), Vec3d(-0.97, 0.3, 0), Vec3d(-0.97, 0.3, 0.1)}, {{0, 1, 2}}, {}};
    const Binding corners(notched, across.points, Coordinates::green);
    BOOST_CHECK_EXCEPTION(invertedTriangles(corners, across, {notched.points}), InputError,
                          [](const InputError& error) { return std::string(error.what()).find("inversions: ") == 0; });
}

BOOST_AUTO_TEST_SUITE_END()
