// Based on: Meijster, Roerdink, Hesselink, A General Algorithm for Computing Distance Transforms in Linear Time, 2000.
// Differs: several lines are processed side by side, so that memory is read along its rows.
#include "rivals.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Morphology.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace vdbcage::bench {

namespace {

using Index = std::ptrdiff_t;

/// Squared distances of the voxels of a box, in the order of OpenVDB's default dense layout (z fastest).
class DenseDistances {
public:
    explicit DenseDistances(const openvdb::CoordBBox& box)
        : box_(box), x_(box.dim().x()), y_(box.dim().y()), z_(box.dim().z()),
          squares_(static_cast<std::size_t>(x_ * y_ * z_), far)
    {
    }

    /// Sets 0 where `mask` is active.
    void setFrom(const openvdb::MaskTree& mask)
    {
        tbb::parallel_for(Index{0}, x_, [&](Index x) {
            const openvdb::tree::ValueAccessor<const openvdb::MaskTree> accessor(mask);
            for (Index y = 0; y < y_; ++y) {
                for (Index z = 0; z < z_; ++z) {
                    if (accessor.isValueOn(coord(x, y, z))) squares_[at(x, y, z)] = 0;
                }
            }
        });
    }
    /// Sets 0 where the distance is above a radius, far elsewhere.
    void turnOver(std::int32_t squaredRadius)
    {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, squares_.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                squares_[i] = squares_[i] > squaredRadius ? 0 : far;
        });
    }
    /// Turns zeros and fars into the squared distance to the nearest zero.
    void transform()
    {
        tbb::parallel_for(Index{0}, x_, [&](Index x) {
            for (Index y = 0; y < y_; ++y) scanLine(&squares_[at(x, y, 0)]);
            for (Index z = 0; z < z_; z += lanes)
                lowerEnvelopes(&squares_[at(x, 0, z)], z_, y_, std::min(lanes, z_ - z));
        });
        tbb::parallel_for(Index{0}, y_, [&](Index y) {
            for (Index z = 0; z < z_; z += lanes) {
                lowerEnvelopes(&squares_[at(0, y, z)], y_ * z_, x_, std::min(lanes, z_ - z));
            }
        });
    }
    openvdb::MaskTree::Ptr above(std::int32_t squaredRadius) const
    {
        std::vector<openvdb::MaskTree> slabs;
        for (Index x = 0; x < x_; x += slab) slabs.emplace_back(false);
        tbb::parallel_for(std::size_t{0}, slabs.size(), [&](std::size_t i) {
            openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(slabs[i]);
            const Index first = static_cast<Index>(i) * slab;
            for (Index x = first; x < std::min(first + slab, x_); ++x) {
                for (Index y = 0; y < y_; ++y) {
                    for (Index z = 0; z < z_; ++z) {
                        if (squares_[at(x, y, z)] > squaredRadius) accessor.setValueOn(coord(x, y, z));
                    }
                }
            }
        });
        auto tree = std::make_shared<openvdb::MaskTree>(false);
        for (openvdb::MaskTree& part : slabs) tree->topologyUnion(part);
        return tree;
    }

private:
    static constexpr std::int32_t far = 1 << 28; // squared, and beyond all squared distances in a box
    static constexpr Index lanes = 16, slab = 64;

    std::size_t at(Index x, Index y, Index z) const { return static_cast<std::size_t>((x * y_ + y) * z_ + z); }
    openvdb::Coord coord(Index x, Index y, Index z) const
    {
        return box_.min().offsetBy(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
    }
    void scanLine(std::int32_t* line) const
    {
        constexpr std::int32_t farLinear = 1 << 14;
        std::int32_t distance = farLinear;
        for (Index z = 0; z < z_; ++z) {
            distance = line[z] == 0 ? 0 : std::min(distance + 1, farLinear);
            line[z] = distance;
        }
        for (Index z = z_; z-- > 0;) {
            distance = std::min(distance + 1, line[z]);
            line[z] = distance;
        }
        for (Index z = 0; z < z_; ++z) line[z] = line[z] * line[z];
    }
    /// Sets line[i] = min over j of line[j] + (i - j)^2, for `count` lines next to each other.
    static void lowerEnvelopes(std::int32_t* lines, Index stride, Index length, Index count)
    {
        thread_local std::vector<std::int32_t> values, result;
        thread_local std::vector<std::int32_t> starts, sites;
        const auto size = static_cast<std::size_t>(length);
        values.resize(size * lanes);
        result.resize(size);
        starts.resize(size);
        sites.resize(size);
        for (Index i = 0; i < length; ++i) {
            for (Index k = 0; k < count; ++k) values[static_cast<std::size_t>(k * length + i)] = lines[i * stride + k];
        }
        for (Index k = 0; k < count; ++k) {
            std::int32_t* const line = values.data() + k * length;
            Index top = -1;
            const auto value = [line](std::int32_t i, std::int32_t site) {
                return (i - site) * (i - site) + line[site];
            };
            for (std::int32_t i = 0; i < static_cast<std::int32_t>(length); ++i) {
                if (line[i] >= far) continue;
                const auto place = [&](Index t) { return static_cast<std::size_t>(t); };
                while (top >= 0 && value(starts[place(top)], sites[place(top)]) > value(starts[place(top)], i)) --top;
                if (top < 0) {
                    top = 0;
                    sites[0] = i;
                    starts[0] = 0;
                    continue;
                }
                const std::int32_t site = sites[place(top)];
                const std::int32_t start = 1 + (i * i - site * site + line[i] - line[site]) / (2 * (i - site));
                if (start >= static_cast<std::int32_t>(length)) continue;
                ++top;
                sites[place(top)] = i;
                starts[place(top)] = start;
            }
            if (top < 0) continue;
            for (auto i = static_cast<std::int32_t>(length); i-- > 0;) {
                result[static_cast<std::size_t>(i)] = value(i, sites[static_cast<std::size_t>(top)]);
                if (i == starts[static_cast<std::size_t>(top)]) --top;
            }
            std::copy(result.begin(), result.end(), line);
        }
        for (Index i = 0; i < length; ++i) {
            for (Index k = 0; k < count; ++k) lines[i * stride + k] = values[static_cast<std::size_t>(k * length + i)];
        }
    }

    openvdb::CoordBBox box_;
    Index x_, y_, z_;
    std::vector<std::int32_t> squares_;
};

} // namespace

openvdb::MaskTree::Ptr closeByDenseDistances(const openvdb::MaskTree& mask, int radius)
{
    openvdb::CoordBBox box;
    if (!mask.evalActiveVoxelBoundingBox(box)) return std::make_shared<openvdb::MaskTree>(false);
    box.expand(radius + 1);
    const std::int32_t squaredRadius = radius * radius;
    DenseDistances distances(box);
    distances.setFrom(mask);
    distances.transform();
    distances.turnOver(squaredRadius);
    distances.transform();
    return distances.above(squaredRadius);
}

openvdb::MaskTree::Ptr closeByRepetition(const openvdb::MaskTree& mask, int radius)
{
    namespace tools = openvdb::tools;
    auto tree = std::make_shared<openvdb::MaskTree>(mask);
    tools::dilateActiveValues(*tree, radius, tools::NN_FACE_EDGE_VERTEX, tools::EXPAND_TILES);
    tools::erodeActiveValues(*tree, radius, tools::NN_FACE_EDGE_VERTEX, tools::EXPAND_TILES);
    return tree;
}

} // namespace vdbcage::bench
