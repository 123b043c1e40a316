#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <vdbcage/geometry/dynamic_bvh.h>

using namespace vdbcage::detail;

namespace {

class Boxes {
public:
    explicit Boxes(unsigned seed) : random_(seed) {}
    Box next()
    {
        Box box;
        const double away = below(4) == 0 ? 100 * unit() : 0;
        for (int i = 0; i < 3; ++i) {
            box.lo[i] = away + unit();
            box.hi[i] = box.lo[i] + 0.2 * unit();
        }
        return box;
    }
    std::size_t below(std::size_t n) { return random_() % n; }

private:
    double unit() { return static_cast<double>(random_()) / 4294967296.0; }

    std::mt19937 random_;
};

std::vector<std::uint32_t> found(const DynamicBvh& tree, const Box& box)
{
    std::vector<std::uint32_t> list;
    tree.forEachOverlap(box, [&](std::uint32_t thing, const Box& /*box*/) {
        list.push_back(thing);
        return true;
    });
    std::sort(list.begin(), list.end());
    return list;
}

std::vector<std::uint32_t> expected(const std::vector<Box>& boxes, const std::vector<char>& alive, const Box& box)
{
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (alive[i] && boxes[i].meets(box)) list.push_back(i);
    }
    return list;
}

} // namespace

BOOST_AUTO_TEST_SUITE(dynamic_bvh)

BOOST_AUTO_TEST_CASE(finds_what_a_list_finds_while_things_come_move_and_go)
{
    for (const std::size_t atFirst : {0U, 1U, 2U, 60U, 2000U}) {
        Boxes random(static_cast<unsigned>(atFirst));
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < atFirst; ++i) boxes.push_back(random.next());
        std::vector<char> alive(atFirst, 1);
        DynamicBvh tree(boxes);
        for (int step = 0; step < 600; ++step) {
            const std::size_t thing = boxes.empty() ? 0 : random.below(boxes.size());
            switch (boxes.empty() ? 0 : random.below(step < 200 ? 3 : 4)) {
            case 0:
                boxes.push_back(random.next());
                alive.push_back(1);
                tree.insert(static_cast<std::uint32_t>(boxes.size() - 1), boxes.back());
                break;
            case 1:
            case 2:
                if (!alive[thing]) break;
                boxes[thing] = random.next();
                tree.update(static_cast<std::uint32_t>(thing), boxes[thing]);
                break;
            default:
                if (!alive[thing]) break;
                alive[thing] = 0;
                tree.remove(static_cast<std::uint32_t>(thing));
            }
            if (random.below(2) == 0) tree.rebuildIfWorthwhile();
            if (random.below(3) > 0) continue;
            tree.refit();
            for (const Box& box : {random.next(), thing < boxes.size() ? boxes[thing] : random.next()}) {
                BOOST_REQUIRE(found(tree, box) == expected(boxes, alive, box));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(boxes_beyond_floats_meet_what_is_there_and_nothing_else)
{
    constexpr double huge = 1e300, infinite = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 60U}) { // with and without absent children
        Boxes random(static_cast<unsigned>(count));
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < count; ++i) boxes.push_back(random.next());
        boxes.back() = {Vec3d(huge), Vec3d(2 * huge)};
        std::vector<char> alive(count, 1);
        DynamicBvh tree(boxes);
        for (const bool isFirstGone : {false, true}) {
            if (isFirstGone) {
                tree.remove(0);
                tree.refit();
                alive[0] = 0;
            }
            for (const double least : {-infinite, -huge, 0.0, huge}) {
                for (const double most : {1.5 * huge, infinite}) {
                    const Box box{Vec3d(least), Vec3d(most)};
                    BOOST_TEST(found(tree, box) == expected(boxes, alive, box));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(stops_where_it_is_told)
{
    const Box box{Vec3d(0.0), Vec3d(1.0)};
    DynamicBvh tree({box, box, box});
    tree.insert(3, box);
    for (int most = 1; most <= 4; ++most) {
        int visits = 0;
        BOOST_TEST(!tree.forEachOverlap(box, [&](std::uint32_t, const Box&) { return ++visits < most; }));
        BOOST_TEST(visits == most);
    }
}

BOOST_AUTO_TEST_SUITE_END()
