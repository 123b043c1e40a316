// Based on: Barber, Dobkin, Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996, as in libqhull.

#include <vdbcage/volume/convex_hull.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <libqhull_r/qhull_ra.h>
#include <openvdb/tools/Prune.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// A facet. Points p with normal . p + offset <= 0 are inside.
struct Facet {
    double normal[3];
    double offset;
};

/// One run of Qhull, which keeps its messages.
class Qhull {
public:
    explicit Qhull(std::vector<double>& points) : messages_(::open_memstream(&text_, &size_))
    {
        if (!messages_) throw std::bad_alloc();
        qh_zero(&qh_, messages_);
        char command[] = "qhull";
        status_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size() / 3), points.data(), False, command, nullptr,
                               messages_);
    }
    ~Qhull()
    {
        int longBytes = 0, longBlocks = 0;
        qh_freeqhull(&qh_, !qh_ALL);
        qh_memfreeshort(&qh_, &longBytes, &longBlocks);
        std::fclose(messages_);
        std::free(text_);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    std::vector<Facet> facets()
    {
        if (status_ == qh_ERRmem) throw std::bad_alloc();
        if (status_ != 0) {
            std::fflush(messages_);
            throw Error("convex hull: " + std::string(text_, size_));
        }
        std::vector<Facet> list;
        for (const facetT* f = qh_.facet_list; f && f->next; f = f->next) {
            list.push_back({{f->normal[0], f->normal[1], f->normal[2]}, f->offset});
        }
        return list;
    }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    std::FILE* messages_;
    qhT qh_;
    int status_ = 0; ///< as returned by qh_new_qhull
};

/// The lowest and the highest corner of each column of corners between columns of voxels.
class CornerColumns {
public:
    explicit CornerColumns(const CoordBBox& box)
        : origin_(box.min()), sizeX_(box.dim().x() + 1), sizeY_(box.dim().y() + 1),
          columns_(static_cast<std::size_t>(sizeX_) * static_cast<std::size_t>(sizeY_))
    {
    }

    void add(const CoordBBox& voxels)
    {
        for (int x = voxels.min().x(); x <= voxels.max().x() + 1; ++x) {
            for (int y = voxels.min().y(); y <= voxels.max().y() + 1; ++y) {
                Column& column = columns_[index(x - origin_.x(), y - origin_.y())];
                column.low = std::min(column.low, voxels.min().z());
                column.high = std::max(column.high, voxels.max().z() + 1);
            }
        }
    }

    /// Returns x, y, z of each, where voxels have their centres at integers from the origin of the box.
    std::vector<double> points() const
    {
        std::vector<double> list;
        for (int x = 0; x < sizeX_; ++x) {
            for (int y = 0; y < sizeY_; ++y) {
                const Column& column = columns_[index(x, y)];
                if (column.high < column.low) continue;
                for (const int z : {column.low, column.high}) {
                    list.insert(list.end(), {x - 0.5, y - 0.5, z - origin_.z() - 0.5});
                }
            }
        }
        return list;
    }

private:
    struct Column {
        std::int32_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::min();
    };

    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(x) * static_cast<std::size_t>(sizeY_) + static_cast<std::size_t>(y);
    }

    Coord origin_;
    int sizeX_, sizeY_;
    std::vector<Column> columns_;
};

} // namespace

openvdb::MaskGrid::Ptr convexHull(const openvdb::MaskGrid& mask, Interrupter* interrupter)
{
    constexpr int mostExtent = 1 << 20;
    constexpr std::int64_t mostColumns = 1 << 28;
    // Centres on a facet are inside. Qhull's facets are off by rounding, about 1e-14 of the extent.
    constexpr double onFacet = 1e-7;
    const openvdb::MaskGrid::Ptr result = detail::maskGridLike(mask, detail::emptyTree<openvdb::MaskTree>(false));
    const CoordBBox box = detail::isolated([&] { return mask.evalActiveVoxelBoundingBox(); });
    if (mask.empty() || box.empty()) return result;
    const Coord size = box.dim();
    if (size[box.maxExtent()] > mostExtent || std::int64_t(size.x()) * size.y() > mostColumns) {
        throw Error("convex hull: a mask of " + std::to_string(size.x()) + " x " + std::to_string(size.y()) + " x " +
                    std::to_string(size.z()) + " voxels is too large; 2^20 and 2^28 columns are allowed");
    }
    CornerColumns corners(box);
    std::size_t visited = 0;
    for (auto voxel = mask.cbeginValueOn(); voxel; ++voxel) {
        if (visited++ % 65536 == 0) throwIfInterrupted(interrupter);
        CoordBBox voxels;
        voxel.getBoundingBox(voxels);
        corners.add(voxels);
    }
    std::vector<double> points = corners.points();
    const std::vector<Facet> facets = Qhull(points).facets();
    for (int x = 0; x < size.x(); ++x) {
        throwIfInterrupted(interrupter);
        for (int y = 0; y < size.y(); ++y) {
            double low = 0, high = size.z() - 1;
            for (const Facet& f : facets) {
                const double room = onFacet - (f.normal[0] * x + f.normal[1] * y + f.offset); // for normal z * z
                if (f.normal[2] > 0) high = std::min(high, room / f.normal[2]);
                if (f.normal[2] < 0) low = std::max(low, room / f.normal[2]);
                if (f.normal[2] == 0 && room < 0) high = -1;
            }
            if (!(std::ceil(low) <= std::floor(high))) continue;
            const Coord first = box.min().offsetBy(x, y, static_cast<int>(std::ceil(low)));
            const Coord last = box.min().offsetBy(x, y, static_cast<int>(std::floor(high)));
            result->tree().fill(CoordBBox(first, last), true, true);
        }
    }
    detail::isolated([&] { openvdb::tools::prune(result->tree()); });
    return result;
}

} // namespace vdbcage
