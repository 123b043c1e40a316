#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <random>

#include <openvdb/tools/Prune.h>
#include <support/stop_at.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/fill.h>

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Coord;
using openvdb::CoordBBox;

namespace {

void setOn(BitGrid& bits, const Coord& ijk)
{
    const Coord at = ijk - bits.box().min();
    bits.row(at.x(), at.y())[at.z() / 64] |= BitGrid::Word(1) << (at.z() % 64);
}

/// Random boxes and random voxels in `box`, in a bit grid and, set one by one, in a mask.
struct Sample {
    BitGrid bits;
    openvdb::MaskGrid::Ptr naive = openvdb::MaskGrid::create();

    Sample(const CoordBBox& box, std::uint32_t seed) : bits(box)
    {
        std::mt19937 random(seed);
        const auto between = [&](int low, int high) {
            return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
        };
        auto accessor = naive->getAccessor();
        const auto set = [&](const Coord& ijk) {
            setOn(bits, ijk);
            accessor.setValueOn(ijk);
        };
        const auto anyVoxel = [&] {
            const int x = between(box.min().x(), box.max().x()), y = between(box.min().y(), box.max().y());
            return Coord(x, y, between(box.min().z(), box.max().z()));
        };
        for (int i = 0; i < 200; ++i) set(anyVoxel());
        for (int i = 0; i < 3; ++i) {
            const Coord a = anyVoxel(), b = anyVoxel();
            for (const Coord& ijk : CoordBBox(Coord::minComponent(a, b), Coord::maxComponent(a, b))) set(ijk);
        }
        openvdb::tools::prune(naive->tree());
    }
};

const CoordBBox boxes[] = {
    {{0, 0, 0}, {0, 0, 0}},          {{-1, -1, -1}, {0, 0, 0}},           {{0, 0, 0}, {31, 31, 63}},
    {{-5, 3, -77}, {20, 40, 95}},    {{1, 2, 3}, {9, 140, 133}},          {{-9, -9, -129}, {-2, -1, -1}},
    {{-3, -130, 7}, {8, 5, 7 + 63}}, {{120, 4090, 60}, {140, 4100, 200}},
};

} // namespace

BOOST_AUTO_TEST_SUITE(bit_grid)

BOOST_DATA_TEST_CASE(a_mask_is_what_setting_voxel_by_voxel_gives, boost::unit_test::data::xrange(8), shape)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.5);
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        const Sample sample(boxes[shape], seed);
        const openvdb::MaskGrid::Ptr mask = toMask(sample.bits, transform);
        BOOST_TEST(mask->activeVoxelCount() == sample.naive->activeVoxelCount());
        BOOST_TEST(mask->tree().hasSameTopology(sample.naive->tree())); // also the tiles: both are pruned
        BOOST_TEST((mask->transformPtr() == transform));
    }
}

BOOST_AUTO_TEST_CASE(full_nodes_become_tiles)
{
    const CoordBBox box(Coord(-128, 0, 0), Coord(127, 127, 130));
    BitGrid bits(box);
    for (const Coord& ijk : box) setOn(bits, ijk);
    const openvdb::MaskGrid::Ptr mask = toMask(bits, openvdb::math::Transform::createLinearTransform());
    BOOST_TEST(mask->activeVoxelCount() == box.volume());
    BOOST_TEST(mask->tree().activeTileCount() == 2U);
    openvdb::MaskTree pruned(mask->tree());
    openvdb::tools::prune(pruned);
    BOOST_TEST(mask->tree().hasSameTopology(pruned));
}

BOOST_AUTO_TEST_CASE(nothing_set_is_an_empty_mask)
{
    const BitGrid bits(boxes[3]);
    BOOST_TEST(toMask(bits, openvdb::math::Transform::createLinearTransform())->empty());
}

BOOST_AUTO_TEST_CASE(every_question_can_cancel_a_mask)
{
    const Sample sample(boxes[3], 7);
    const auto transform = openvdb::math::Transform::createLinearTransform();
    constexpr int many = 1 << 20;
    test::StopAt counter(many);
    toMask(sample.bits, transform, &counter);
    const int asked = test::questions(counter, many);
    BOOST_TEST(asked > 0);
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(toMask(sample.bits, transform, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(fill)

namespace {

/// What fillEnclosed is to do, by a walk from voxel to voxel.
std::size_t countAfterWalk(const BitGrid& bits)
{
    const CoordBBox box = bits.box().expandBy(1);
    const auto isOn = [&](const Coord& ijk) {
        const Coord at = ijk - bits.box().min();
        return bits.box().isInside(ijk) && bits.row(at.x(), at.y())[at.z() / 64] >> (at.z() % 64) & 1;
    };
    openvdb::MaskGrid::Ptr outside = openvdb::MaskGrid::create();
    auto accessor = outside->getAccessor();
    std::vector<Coord> walk{box.min()};
    accessor.setValueOn(box.min());
    while (!walk.empty()) {
        const Coord ijk = walk.back();
        walk.pop_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                Coord next = ijk;
                next[axis] += step;
                if (!box.isInside(next) || isOn(next) || accessor.isValueOn(next)) continue;
                accessor.setValueOn(next);
                walk.push_back(next);
            }
        }
    }
    return box.volume() - outside->activeVoxelCount();
}

std::size_t count(const BitGrid& bits)
{
    std::size_t total = 0;
    for (std::size_t i = 0; i < bits.wordCount(); ++i) {
        total += static_cast<std::size_t>(__builtin_popcountll(bits.words()[i]));
    }
    return total;
}

} // namespace

BOOST_DATA_TEST_CASE(random_caves_fill_as_a_walk_says, boost::unit_test::data::xrange(24), seed)
{
    // Around this density the empty voxels are just about to fall apart into separate caves.
    const double density = 0.5 + 0.01 * seed;
    const CoordBBox box(Coord(-4, 3, 0), Coord(-4 + 11, 3 + 17, 63 + seed * 5));
    BitGrid bits(box), before(box);
    std::mt19937 random(static_cast<unsigned>(seed));
    for (const Coord& ijk : box) {
        if (double(random()) < density * double(random.max())) setOn(bits, ijk);
    }
    std::copy_n(bits.words(), bits.wordCount(), before.words());
    fillEnclosed(bits);
    BOOST_TEST(count(bits) == countAfterWalk(before));
    bool extensive = true;
    for (std::size_t i = 0; i < bits.wordCount(); ++i) extensive &= (before.words()[i] & ~bits.words()[i]) == 0;
    BOOST_TEST(extensive);
}

BOOST_AUTO_TEST_CASE(a_long_way_out_is_found)
{
    // Plates across x with a hole at alternating corners, in a closed case with one hole.
    const CoordBBox box(Coord(0), Coord(20, 20, 140));
    for (const bool open : {true, false}) {
        BitGrid bits(box), before(box);
        for (const Coord& ijk : box) {
            const bool plate = ijk.x() % 2 == 0;
            const bool hole = ijk.x() / 2 % 2 == 0 ? ijk.y() == 1 && ijk.z() == 1 : ijk.y() == 19 && ijk.z() == 139;
            const bool wall = ijk.y() % 20 == 0 || ijk.z() % 140 == 0;
            const bool closed = ijk.x() == 20 || (!open && ijk.x() == 0);
            if (wall || (plate && (!hole || closed))) setOn(bits, ijk);
        }
        std::copy_n(bits.words(), bits.wordCount(), before.words());
        fillEnclosed(bits);
        BOOST_TEST(count(bits) == (open ? count(before) : box.volume()));
    }
}

BOOST_AUTO_TEST_SUITE_END()
