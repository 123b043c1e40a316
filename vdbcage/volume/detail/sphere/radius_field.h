#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/core/detail/grids.h>
#include <vdbcage/volume/detail/progress.h>
#include <vdbcage/volume/factor_field.h>

namespace vdbcage::detail {

/// A radius for each voxel, as its square, a whole number.
///
/// A scatter erosion removes all g with a voxel q outside such that |g - q|^2 <= square(q). The squares are chosen so
/// that the q with a face neighbour inside are enough to remove all of it.
///
/// For this, each g within the radius of q that is more than one step along an axis away must be within the radius of a
/// face neighbour of q that is nearer to g. A step towards g gains at least half a voxel, unless g is very near. It is
/// thus enough that radii change by less than half a voxel a step. Small radii have a slightly smaller square than
/// their own (see leastRadius_).
class RadiusField {
public:
    /// Makes the radii of the voxels of `box`, in the index space of `voxels`.
    /// \throw InputError as closeMask with a scale field
    /// \throw Cancelled
    RadiusField(const FactorField& scale, const openvdb::math::Transform& voxels, double radius,
                const openvdb::CoordBBox& box, const Progress& progress);

    /// Returns whether the radius is `largest()` everywhere.
    bool isUniform() const { return nodes_.empty(); }
    double largest() const { return largest_; }
    /// Returns the square at a voxel of the radius times `factor`, which is 0 to 1.
    std::int32_t square(const openvdb::Coord& voxel, double factor) const;
    /// Bounds of the radius among the voxels of an entry.
    struct Range {
        float least, most;
    };
    Range rangeOfEntry(const openvdb::Coord& origin) const;
    /// Returns the largest square that a radius may stand for.
    std::int32_t squareOf(double radius) const;

private:
    float radiusAt(const openvdb::Coord& voxel) const;
    void sample(const FactorField& scale, const openvdb::math::Transform& voxels, double radius,
                const Progress& progress);
    void clamp(const Progress& progress);
    void findRanges(const Progress& progress);

    std::size_t node(const openvdb::Coord& c) const // counted in nodes from the first
    {
        return (static_cast<std::size_t>(c.x()) * static_cast<std::size_t>(size_.y()) +
                static_cast<std::size_t>(c.y())) *
                   static_cast<std::size_t>(size_.z()) +
               static_cast<std::size_t>(c.z());
    }

    int shift_ = 0;                       // nodes are at the multiples of 2^shift
    openvdb::Coord first_, size_;         // in nodes
    std::vector<float> nodes_;            // radii
    openvdb::Coord firstEntry_, entries_; // in entries
    std::vector<Range> ranges_;
    float outside_ = 0; // the radius where there are no nodes
    double largest_ = 0;
    std::vector<double> leastRadius_; // by square: the least radius that may stand for it
};

} // namespace vdbcage::detail
