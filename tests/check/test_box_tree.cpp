#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <support/triangle_soup.h>
#include <vdbcage/check/detail/box_tree.h>
#include <vdbcage/check/detail/predicates.h>

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

using Soup = test::TriangleSoup;

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
    Vec3d point() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

    /// Of any size from a millionth on, and sometimes flat along an axis, a needle or a point.
    Corners triangle(double unit)
    {
        const double size = std::pow(10.0, between(-6, 0));
        Corners corners;
        const Vec3d middle = point();
        for (Vec3d& p : corners) p = unit * (middle + size * point());
        switch (static_cast<int>(between(0, 8))) {
        case 0:
            for (Vec3d& p : corners) p[1] = corners[0][1];
            break;
        case 1:
            corners[2] = corners[0] + 0.5 * (corners[1] - corners[0]);
            break;
        case 2:
            corners[1] = corners[2] = corners[0];
            break;
        default:
            break;
        }
        return corners;
    }

private:
    std::mt19937 engine_;
};

Soup randomSoup(Random& random, std::size_t count, double unit)
{
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) soup.add(random.triangle(unit));
    return soup;
}

/// A square of 2 n n triangles in the plane z = 0.
Soup plane(int n)
{
    Soup soup;
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            const Vec3d p(x, y, 0), q(x + 1, y, 0), r(x + 1, y + 1, 0), s(x, y + 1, 0);
            soup.add({p, q, r});
            soup.add({p, r, s});
        }
    }
    return soup;
}

/// Long thin triangles side by side along `direction`, some of them a line.
Soup needles(Random& random, std::size_t count, Vec3d direction)
{
    direction.normalize();
    const Vec3d across = Vec3d(0, 0, 1).cross(direction).unit(), up = direction.cross(across);
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d p = random.between(-40, 40) * across + random.between(-3, 3) * up;
        const Vec3d side = i % 10 == 0 ? Vec3d(0.0) : random.between(-1, 1) * across + random.between(-1, 1) * up;
        soup.add({p - 5000 * direction, p + 5000 * direction, p + side - 5000 * direction});
    }
    return soup;
}

using Found = std::multiset<std::uint32_t>;

Found inBox(const BoxTree& tree, const Box& box)
{
    Found found;
    BOOST_TEST(tree.inBox(box, [&](const BoxTree::Item& item) { return found.insert(item.triangle), true; }));
    return found;
}

Found nearTo(const BoxTree& tree, const Corners& triangle, double distance)
{
    Found found;
    BOOST_TEST(
        tree.near(triangle, distance, [&](const BoxTree::Item& item) { return found.insert(item.triangle), true; }));
    return found;
}

bool isSet(const Found& found)
{
    return std::adjacent_find(found.begin(), found.end()) == found.end();
}

} // namespace

BOOST_AUTO_TEST_SUITE(box_tree)

BOOST_AUTO_TEST_CASE(finds_all_that_meet)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double unit : {1.0, 1e-70, 1e70, 1e-160, 1e150, 3e-310}) {
        for (const std::size_t count : {1U, 3U, 4U, 5U, 17U, 300U}) {
            Random random(static_cast<unsigned>(count));
            const Soup soup = randomSoup(random, count, unit);
            const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
            BOOST_TEST(tree.size() == count);
            for (int query = 0; query < 60; ++query) {
                const Corners triangle = random.triangle(unit);
                Box box = Box::of(triangle);
                if (query % 5 == 0) box.hi[0] = infinity;
                const Found boxed = inBox(tree, box), close = nearTo(tree, triangle, 0);
                BOOST_TEST(isSet(boxed));
                BOOST_TEST(isSet(close));
                for (std::uint32_t t = 0; t < count; ++t) {
                    const Corners other = soup.corners(t);
                    if (box.meets(Box::of(other))) BOOST_TEST(boxed.count(t) == 1U);
                    if (trianglesMeet(triangle, other)) BOOST_TEST(close.count(t) == 1U);
                }
            }
            // Each meets itself.
            for (std::uint32_t t = 0; t < count; ++t) BOOST_TEST(nearTo(tree, soup.corners(t), 0).count(t) == 1U);
        }
    }
}

BOOST_AUTO_TEST_CASE(finds_all_within_a_distance)
{
    Random random(3);
    const Soup soup = randomSoup(random, 500, 1);
    const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
    for (int query = 0; query < 100; ++query) {
        const Corners triangle = random.triangle(1);
        const double distance = std::pow(10.0, random.between(-4, 0));
        const Found found = nearTo(tree, triangle, distance);
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            // Moved by that distance in any direction it must still be found.
            Vec3d direction = random.point();
            direction.normalize();
            Corners moved = soup.corners(t);
            for (Vec3d& p : moved) p += 0.999 * distance * direction;
            if (trianglesMeet(triangle, moved)) BOOST_TEST(found.count(t) == 1U);
        }
    }
}

// The plane's slab is rounded: a point in the middle of an edge, whose coordinates are exact, lies on its border.
BOOST_AUTO_TEST_CASE(finds_points_on_edges)
{
    std::mt19937 engine(11);
    const auto corner = [&] {
        std::uniform_int_distribution<int> place(-20, 20);
        const int x = place(engine), y = place(engine), z = place(engine);
        return Vec3d(x, y, z);
    };
    for (int i = 0; i < 1000; ++i) {
        const Corners triangle{corner(), corner(), corner()};
        for (std::size_t k = 0; k < 3; ++k) {
            Soup soup;
            const Vec3d middle = 0.5 * (triangle[k] + triangle[(k + 1) % 3]);
            soup.add({middle, middle, middle});
            const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
            BOOST_TEST(nearTo(tree, triangle, 0).size() == 1U);
        }
    }
}

BOOST_AUTO_TEST_CASE(needles_that_come_near_are_found, *boost::unit_test::label("property"))
{
    Random random(12);
    for (const Vec3d& direction : {Vec3d(0.6, 0.75, 0.27), Vec3d(1, -1, 1e-3), Vec3d(1, 0, 0)}) {
        Soup soup = needles(random, 300, direction);
        for (int i = 0; i < 30; ++i) soup.add(random.triangle(100)); // and others
        for (const double unit : {1.0, 1e-9, 1e290}) {
            Soup scaled = soup;
            for (Vec3d& p : scaled.points) p *= unit;
            const BoxTree tree(scaled.points, scaled.triangles, BoxTree::Copies::keep, nullptr);
            for (int i = 0; i < 60; ++i) {
                // A corner on a triangle, to within rounding, or as far from it as is asked for.
                const auto t = static_cast<std::uint32_t>(random.between(0, 330));
                const Corners other = scaled.corners(t);
                const double place = random.between(0, 1), far = i % 3 == 0 ? 1e307 : 100 * unit;
                const double distance = i % 2 == 0 ? 0 : unit * random.between(0, 5);
                Vec3d p = place * other[0] + (1 - place) * other[1];
                if (i % 2 == 1) p += 0.999 * distance * random.point().unit();
                if (i % 2 == 0) p = other[static_cast<std::size_t>(i) % 3];
                const Found found = nearTo(tree, {p, p + far * random.point(), p + far * random.point()}, distance);
                BOOST_TEST(found.count(t) == 1U);
                BOOST_TEST(isSet(found));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(looks_at_few_needles_also_at_an_angle)
{
    const auto looks = [](const Vec3d& direction) {
        Random random(13);
        const Soup soup = needles(random, 3000, direction);
        const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::drop, nullptr);
        const Vec3d along = direction.unit(), across = Vec3d(0, 0, 1).cross(along).unit();
        std::size_t found = 0;
        for (int i = 0; i < 100; ++i) {
            const Vec3d p = random.between(-4000, 4000) * along + random.between(-40, 40) * across;
            found += nearTo(tree, {p, p + 400 * along, p + 5 * across}, 0.5).size();
        }
        return found;
    };
    const std::size_t straight = looks({1, 0, 0});
    for (const Vec3d& direction : {Vec3d(0.6, 0.75, 0.27), Vec3d(1, -1, 0)}) {
        BOOST_TEST(looks(direction) < 10 * straight);
        BOOST_TEST(looks(direction) < 60000U); // of 300000
    }
}

// One triangle far away: all others are in one cell of the curve.
BOOST_AUTO_TEST_CASE(looks_at_few_also_where_one_is_far_away)
{
    Soup soup = plane(40);
    std::shuffle(soup.triangles.begin(), soup.triangles.end(), std::mt19937(1));
    soup.add({Vec3d(1e9), Vec3d(1e9, 1e9, 2e9), Vec3d(1e9, 2e9, 1e9)});
    const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
    BOOST_TEST(tree.size() == soup.triangles.size());
    BOOST_TEST(inBox(tree, {Vec3d(20.2, 20.2, 0), Vec3d(20.8, 20.8, 0)}).size() < 40U);
}

BOOST_AUTO_TEST_CASE(passes_over_what_is_beside_the_plane)
{
    const Soup soup = plane(40);
    const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
    const Corners slanted{Vec3d(1, 1, -5), Vec3d(39, 1, -5), Vec3d(20, 39, 5)};
    std::size_t meeting = 0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) meeting += trianglesMeet(slanted, soup.corners(t)) ? 1 : 0;
    BOOST_TEST(meeting > 20U);
    BOOST_TEST(inBox(tree, Box::of(slanted)).size() > 2500U);
    BOOST_TEST(inBox(tree, {Vec3d(0.0), Vec3d(40, 40, 0)}).size() == soup.triangles.size());
    BOOST_TEST(nearTo(tree, slanted, 0).size() < 20 * meeting);
    const Corners above{Vec3d(0, 0, 0.1), Vec3d(40, 0, 0.1), Vec3d(0, 40, 0.1)};
    BOOST_TEST(nearTo(tree, above, 0).empty());
    BOOST_TEST(nearTo(tree, above, 0.2).size() > 1600U);
}

BOOST_AUTO_TEST_CASE(copies_are_dropped_if_asked)
{
    Random random(5);
    Soup soup = randomSoup(random, 40, 1);
    // Each twice more: turned, and the other way round.
    for (std::size_t t = 0; t < 40; ++t) {
        const Corners c = soup.corners(t);
        soup.add({c[1], c[2], c[0]});
        soup.add({c[1], c[0], c[2]});
    }
    BOOST_TEST(BoxTree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr).size() == 120U);
    const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::drop, nullptr);
    BOOST_TEST(tree.size() == 40U);
    for (std::uint32_t t = 0; t < 40; ++t) BOOST_TEST(nearTo(tree, soup.corners(t), 0).count(t) == 1U); // the first
}

BOOST_AUTO_TEST_CASE(stops_where_it_is_told_to)
{
    const Soup soup = plane(10);
    const BoxTree tree(soup.points, soup.triangles, BoxTree::Copies::keep, nullptr);
    int visits = 0;
    BOOST_TEST(!tree.inBox({Vec3d(-1), Vec3d(11)}, [&](const BoxTree::Item&) { return ++visits < 7; }));
    BOOST_TEST(visits == 7);
    BOOST_TEST(BoxTree().inBox({Vec3d(0.0), Vec3d(1)}, [](const BoxTree::Item&) { return false; }));
    BOOST_TEST(BoxTree({}, {}, BoxTree::Copies::drop, nullptr).size() == 0U);
}

BOOST_AUTO_TEST_SUITE_END()
