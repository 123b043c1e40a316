#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <openvdb/openvdb.h>

/// Masks to test on, and the plain dense sets to compare with.
namespace vdbcage::test {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskGrid;

/// A box of voxels, densely; outside of it everything is `outside`.
class DenseSet {
public:
    explicit DenseSet(const CoordBBox& box, bool value = false) : box_(box), bits_(box.volume(), value) {}
    DenseSet(const MaskGrid& grid, const CoordBBox& box) : DenseSet(box)
    {
        auto accessor = grid.getConstAccessor();
        for (auto c = box.begin(); c; ++c) set(*c, accessor.isValueOn(*c));
    }
    const CoordBBox& box() const { return box_; }
    bool operator[](const Coord& c) const { return box_.isInside(c) && bits_[index(c)]; }
    void set(const Coord& c, bool value) { bits_[index(c)] = value; }

private:
    std::size_t index(const Coord& c) const
    {
        const Coord d = c - box_.min();
        const Coord size = box_.dim();
        return (static_cast<std::size_t>(d.x()) * static_cast<std::size_t>(size.y()) +
                static_cast<std::size_t>(d.y())) *
                   static_cast<std::size_t>(size.z()) +
               static_cast<std::size_t>(d.z());
    }
    CoordBBox box_;
    std::vector<bool> bits_;
};

inline MaskGrid::Ptr toGrid(const DenseSet& set)
{
    auto grid = MaskGrid::create();
    auto accessor = grid->getAccessor();
    for (auto c = set.box().begin(); c; ++c) {
        if (set[*c]) accessor.setValueOn(*c);
    }
    return grid;
}

/// Balls, boxes and single voxels at random within the box.
inline DenseSet randomBlobs(const CoordBBox& box, unsigned seed, int count = 8)
{
    std::mt19937 random(seed);
    DenseSet set(box);
    const auto within = [&](int axis) {
        return std::uniform_int_distribution<int>(box.min()[axis], box.max()[axis])(random);
    };
    for (int i = 0; i < count; ++i) {
        const Coord centre(within(0), within(1), within(2));
        const int radius = std::uniform_int_distribution<int>(0, 6)(random);
        const bool isBall = random() % 2 == 0;
        const bool isHole = random() % 4 == 0;
        CoordBBox around(centre - Coord(radius), centre + Coord(radius));
        around.intersect(box);
        for (auto c = around.begin(); c; ++c) {
            const Coord d = *c - centre;
            if (!isBall || d.x() * d.x() + d.y() * d.y() + d.z() * d.z() <= radius * radius) set.set(*c, !isHole);
        }
    }
    return set;
}

inline MaskGrid::Ptr gridFrom(const CoordBBox& box, const std::function<bool(const openvdb::Vec3d&)>& isInside)
{
    auto grid = MaskGrid::create();
    auto accessor = grid->getAccessor();
    for (auto c = box.begin(); c; ++c) {
        if (isInside((*c).asVec3d())) accessor.setValueOn(*c);
    }
    return grid;
}

/// The same set of active voxels, without making tiles dense.
inline bool sameSet(const MaskGrid& a, const MaskGrid& b)
{
    auto onlyA = a.deepCopy(), onlyB = b.deepCopy();
    onlyA->topologyDifference(b);
    onlyB->topologyDifference(a);
    return onlyA->activeVoxelCount() == 0 && onlyB->activeVoxelCount() == 0;
}

inline bool sameTree(const MaskGrid& a, const MaskGrid& b)
{
    return a.constTree().hasSameTopology(b.constTree());
}

} // namespace vdbcage::test
