// Vertices that stick out of flat surroundings.
#include <boost/test/unit_test.hpp>

#include <array>
#include <map>
#include <random>

#include <support/shapes.h>
#include <vdbcage/bounding/detail/triangles/peaks.h>
#include <vdbcage/check/check.h>

using namespace vdbcage;
using openvdb::Vec3d;

BOOST_AUTO_TEST_SUITE(peaks)

namespace {

/// A cube from -1 to 1 of n x n squares a side, as triangles.
Mesh squaredCube(int n)
{
    Mesh mesh;
    std::map<std::array<int, 3>, openvdb::Index32> numbers;
    const auto number = [&](std::array<int, 3> at) {
        const auto [known, isNew] = numbers.try_emplace(at, static_cast<openvdb::Index32>(mesh.points.size()));
        if (isNew) mesh.points.push_back(2.0 / n * Vec3d(at[0], at[1], at[2]) - Vec3d(1));
        return known->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const int end : {0, n}) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const auto corner = [&](int u, int v) {
                        std::array<int, 3> at{};
                        at[static_cast<std::size_t>(axis)] = end;
                        at[static_cast<std::size_t>((axis + 1) % 3)] = i + (end > 0 ? u : v);
                        at[static_cast<std::size_t>((axis + 2) % 3)] = j + (end > 0 ? v : u);
                        return number(at);
                    };
                    mesh.triangles.emplace_back(corner(0, 0), corner(1, 0), corner(1, 1));
                    mesh.triangles.emplace_back(corner(0, 0), corner(1, 1), corner(0, 1));
                }
            }
        }
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(what_sticks_out_is_flattened_and_the_cage_still_bounds)
{
    const Mesh model = test::box(Vec3d(-1), Vec3d(1));
    const BoundingGuard guard(model);
    const Mesh even = test::transformed(squaredCube(6), 1.001, Vec3d(0));
    BOOST_TEST(checkCage(even, model).bounding());
    BOOST_TEST((detail::withoutPeaks(even, guard, {}, nullptr).points == even.points)); // nothing sticks out
    std::mt19937 random(7);
    for (int i = 0; i < 20; ++i) {
        Mesh cage = even;
        for (int k = 0; k < 3; ++k) cage.points[random() % cage.points.size()] *= 1.05 + 0.05 * k;
        const CageCheck before = checkCage(cage, model);
        BOOST_TEST_REQUIRE(before.bounding());
        const Mesh flat = detail::withoutPeaks(cage, guard, {}, nullptr);
        const CageCheck after = checkCage(flat, model);
        BOOST_TEST_CONTEXT(i)
        {
            BOOST_TEST(after.bounding());
            BOOST_TEST(faceCount(flat) <= faceCount(cage));
            BOOST_TEST(after.maxDistance <= before.maxDistance / 2);
            BOOST_TEST(after.meanDistance < before.meanDistance);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
