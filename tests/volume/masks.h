#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <openvdb/openvdb.h>
#include <vdbcage/core/interrupter.h>

/// Masks to test on, and plain dense sets to compare with.
namespace vdbcage::test {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskGrid;

/// The voxels of a box, densely; what lies outside of the box is not in the set.
class DenseSet {
public:
    explicit DenseSet(const CoordBBox& box, bool value = false) : box_(box), bits_(box.volume(), value ? 1 : 0) {}
    DenseSet(const MaskGrid& grid, const CoordBBox& box) : DenseSet(box)
    {
        const auto accessor = grid.getConstAccessor();
        for (auto c = box.begin(); c; ++c) set(*c, accessor.isValueOn(*c));
    }
    const CoordBBox& box() const { return box_; }
    bool operator[](const Coord& c) const { return box_.isInside(c) && bits_[index(c)] != 0; }
    void set(const Coord& c, bool value) { bits_[index(c)] = value ? 1 : 0; }

    std::size_t index(const Coord& c) const
    {
        const Coord d = c - box_.min(), size = box_.dim();
        return (static_cast<std::size_t>(d.x()) * static_cast<std::size_t>(size.y()) +
                static_cast<std::size_t>(d.y())) *
                   static_cast<std::size_t>(size.z()) +
               static_cast<std::size_t>(d.z());
    }
    const std::vector<char>& bits() const { return bits_; }

private:
    CoordBBox box_;
    std::vector<char> bits_;
};

inline CoordBBox grown(CoordBBox box, int by)
{
    box.expand(by);
    return box;
}

inline CoordBBox cubeAt(const Coord& corner, int size)
{
    return CoordBBox::createCube(corner, size);
}

inline MaskGrid::Ptr toGrid(const DenseSet& set)
{
    auto grid = MaskGrid::create();
    auto accessor = grid->getAccessor();
    for (auto c = set.box().begin(); c; ++c) {
        if (set[*c]) accessor.setValueOn(*c);
    }
    return grid;
}

/// Balls, boxes, single voxels and holes of these at random within the box.
inline DenseSet randomBlobs(const CoordBBox& box, unsigned seed, int count = 8)
{
    std::mt19937 random(seed);
    const auto between = [&](int first, int last) {
        return first + static_cast<int>(random() % static_cast<unsigned>(last - first + 1));
    };
    DenseSet set(box);
    for (int i = 0; i < count; ++i) {
        Coord centre;
        for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = between(box.min()[axis], box.max()[axis]);
        const int radius = between(0, 5);
        const bool isBall = random() % 2 == 0, isHole = random() % 4 == 0;
        CoordBBox around = grown(CoordBBox(centre, centre), radius);
        around.intersect(box);
        for (auto c = around.begin(); c; ++c) {
            const Coord d = *c - centre;
            if (!isBall || d.x() * d.x() + d.y() * d.y() + d.z() * d.z() <= radius * radius) set.set(*c, !isHole);
        }
    }
    return set;
}

/// A few fat balls in a cube of this size around the origin, for whatever needs several blocks and tiles.
inline MaskGrid::Ptr fatBlobs(int size, unsigned seed = 1)
{
    std::mt19937 random(seed);
    auto grid = MaskGrid::create();
    for (int i = 0; i < 12; ++i) {
        Coord centre;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            centre[axis] = static_cast<int>(random() % static_cast<unsigned>(size)) - size / 2;
        }
        const int radius = size / 16 + static_cast<int>(random() % static_cast<unsigned>(size / 8));
        auto accessor = grid->getAccessor();
        const CoordBBox box = grown(CoordBBox(centre, centre), radius);
        for (auto c = box.begin(); c; ++c) {
            const Coord d = *c - centre;
            if (d.x() * d.x() + d.y() * d.y() + d.z() * d.z() <= radius * radius) accessor.setValueOn(*c);
        }
    }
    return grid;
}

inline MaskGrid::Ptr shifted(const MaskGrid& grid, const Coord& by)
{
    auto result = MaskGrid::create();
    auto accessor = result->getAccessor();
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        CoordBBox box;
        value.getBoundingBox(box);
        for (auto c = box.begin(); c; ++c) accessor.setValueOn(*c + by);
    }
    return result;
}

/// Whether all of `a` is in `b`, without making tiles dense.
inline bool isSubset(const MaskGrid& a, const MaskGrid& b)
{
    const auto rest = a.deepCopy();
    rest->topologyDifference(b);
    return rest->activeVoxelCount() == 0;
}

inline bool sameSet(const MaskGrid& a, const MaskGrid& b)
{
    return isSubset(a, b) && isSubset(b, a);
}

/// Whether exactly the voxels of `set` are active. Much faster than making a grid of a large one.
inline bool holds(const MaskGrid& grid, const DenseSet& set)
{
    std::size_t count = 0;
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        CoordBBox box;
        value.getBoundingBox(box);
        for (auto c = box.begin(); c; ++c) {
            if (!set[*c]) return false;
            ++count;
        }
    }
    return count == static_cast<std::size_t>(std::count(set.bits().begin(), set.bits().end(), 1));
}

inline bool sameTree(const MaskGrid& a, const MaskGrid& b)
{
    return a.tree().hasSameTopology(b.tree()) && sameSet(a, b);
}

/// Says stop at the check with this number (from 0), and counts the checks.
class StopOnce : public Interrupter {
public:
    explicit StopOnce(int check) : stopAt_(check) {}
    bool wasInterrupted(int percent = -1) override
    {
        if (percent < -1 || percent > 100) outOfRange = true;
        return checks++ == stopAt_;
    }
    std::atomic<int> checks{0};
    std::atomic<bool> outOfRange{false};

private:
    int stopAt_;
};

} // namespace vdbcage::test
