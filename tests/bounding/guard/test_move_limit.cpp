#include <boost/test/unit_test.hpp>

#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/contact_planes.h>
#include <vdbcage/bounding/detail/guard/move_limit.h>
#include <vdbcage/bounding/detail/guard/star_change.h>
#include <vdbcage/bounding/detail/guard/vertex_placement.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

std::vector<MoveLimit> limits(std::mt19937& random)
{
    std::vector<MoveLimit> list;
    for (int i = 0; i < 64; ++i) {
        MoveLimit limit;
        limit.home = test::randomVector(random, 1);
        for (const std::size_t axis : {0U, 1U, 2U}) limit.mayMove[axis] = (i >> axis & 1) != 0;
        if (i % 3 == 0) limit.radius = 0.3;
        if (i % 9 == 0) limit.radius = 0;
        list.push_back(limit);
    }
    return list;
}

} // namespace

BOOST_AUTO_TEST_SUITE(move_limit)

BOOST_AUTO_TEST_CASE(the_nearest_place_is_allowed_and_stays_so_as_floats)
{
    std::mt19937 random(1);
    for (const MoveLimit& limit : limits(random)) {
        BOOST_TEST(limit.allows(limit.home));
        for (int k = 0; k < 20; ++k) {
            const Vec3d p = test::randomVector(random, 2);
            Vec3d near = limit.nearest(p);
            BOOST_TEST(limit.allows(near));
            for (int i = 0; i < 3; ++i) {
                if (near[i] != limit.home[i]) near[i] = static_cast<float>(near[i]);
            }
            BOOST_TEST(limit.allows(near));
            // No other allowed place is much nearer.
            const Vec3d other = limit.nearest(p + test::randomVector(random, 0.5));
            BOOST_TEST((near - p).length() <= (other - p).length() + 1e-5);
        }
    }
}

BOOST_AUTO_TEST_CASE(half_spaces_of_a_plane_agree_with_those_of_space)
{
    std::mt19937 random(2);
    for (int k = 0; k < 200; ++k) {
        const int axis = k % 3;
        const double offset = test::randomVector(random, 1)[0];
        const HalfSpace h{test::randomVector(random, 1).unit(), test::randomVector(random, 1)[0]};
        std::vector<HalfSpace> flat{h};
        restrictToPlane(axis, offset, flat);
        BOOST_REQUIRE(flat.size() == 1U);
        BOOST_TEST(std::abs(flat[0].normal.length() - 1) < 1e-12);
        BOOST_TEST(flat[0].normal[axis] == 0, boost::test_tools::tolerance(1e-15));
        Vec3d p = test::randomVector(random, 1);
        p[axis] = offset;
        const double lack = h.offset - h.normal.dot(p);
        if (std::abs(lack) > 1e-9) BOOST_TEST((lack > 0) == (flat[0].offset - flat[0].normal.dot(p) > 0));
    }
    std::vector<HalfSpace> across{{Vec3d(0, 1, 0), 0.5}};
    restrictToPlane(1, 0, across);
    BOOST_TEST(across.empty());
}

BOOST_AUTO_TEST_CASE(vertices_descend_within_their_limits)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.3, 6), {}, nullptr);
    std::mt19937 random(3);
    int moved = 0;
    for (int k = 0; k < 40; ++k) {
        GuardedMesh surface(test::sphere({0, 0, 0}, 0.5, 6), guard);
        const auto v = static_cast<std::uint32_t>(7 + k);
        MoveLimit limit{surface.point(v), {k % 2 == 0, k % 3 != 0, k % 5 != 0}, k % 4 == 0 ? 0.02 : 1.0};
        surface.limit(v, limit);
        const StarChange star = starOf(surface, v);
        Quadratic change;
        change.curvature = openvdb::Mat3d::identity();
        change.slope = test::randomVector(random, 0.2);
        Vec3d p = surface.point(v);
        const bool found = descend(surface, star, p, change, {0.5, 1.0, 1e-5}, [](const Vec3d&) { return true; });
        BOOST_TEST(limit.allows(p));
        BOOST_TEST(found == (p != surface.point(v)));
        moved += found;
        if (limit.isRail()) BOOST_TEST(!allows(surface, star, surface.point(v) + Vec3d(1e-3)));
    }
    BOOST_TEST(moved > 20);
}

BOOST_AUTO_TEST_SUITE_END()
