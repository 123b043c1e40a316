// Voxels by CGAL's AABB tree, which is GPL: this file is compiled only with VDBCAGE_WITH_CGAL_GPL.
// Based on: Nooruddin and Turk, Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
// Differs: works on the lattice of the other back ends and returns their bits, by independent predicates.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include <CGAL/config.h>
#if CGAL_VERSION_MAJOR < 6
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#else
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range3d.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/voxelize/detail/backend.h>
#include <vdbcage/voxelize/detail/fill.h>
#include <vdbcage/voxelize/detail/parity_vote.h>
#include <vdbcage/voxelize/detail/slabbed_triangles.h>

namespace vdbcage::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Point2 = Kernel::Point_2;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
#if CGAL_VERSION_MAJOR < 6
template <typename Primitive>
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using TriangleBvh = Tree<CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>>;
using SegmentTree = Tree<CGAL::AABB_segment_primitive<Kernel, std::vector<Segment>::const_iterator>>;
#else
template <typename Primitive>
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
using TriangleBvh = Tree<CGAL::AABB_triangle_primitive_3<Kernel, std::vector<Triangle>::const_iterator>>;
using SegmentTree = Tree<CGAL::AABB_segment_primitive_3<Kernel, std::vector<Segment>::const_iterator>>;
#endif
using openvdb::Coord;
using openvdb::CoordBBox;

void flip(BitGrid& bits, const Coord& ijk)
{
    bits.row(ijk.x(), ijk.y())[ijk.z() >> 6] ^= BitGrid::Word(1) << (ijk.z() & 63);
}

/// Returns whether a ray along an axis through `centre` crosses the projection of a triangle. As in
/// Projection::centred, a centre on an edge counts as if it were moved by (e, e^2).
bool crosses(Point2 a, Point2 b, const Point2& c, const Point2& centre)
{
    const CGAL::Orientation turn = CGAL::orientation(a, b, c);
    if (turn == CGAL::COLLINEAR) return false;
    if (turn == CGAL::RIGHT_TURN) std::swap(a, b);
    const auto toTheLeft = [&](const Point2& p, const Point2& q) {
        const CGAL::Orientation side = CGAL::orientation(p, q, centre);
        if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN;
        return q.y() < p.y() || (q.y() == p.y() && q.x() > p.x());
    };
    return toTheLeft(a, b) && toTheLeft(b, c) && toTheLeft(c, a);
}

class CgalVoxelizer {
public:
    CgalVoxelizer(const Mesh& model, const Frame& frame, Interrupter* interrupter)
        : interrupter_(interrupter), surface_(frame.voxels),
          last_(surface_.size().offsetBy(-1)), crossings_{BitGrid(frame.voxels), BitGrid(frame.voxels),
                                                          BitGrid(frame.voxels)}
    {
        const SlabbedTriangles all(model, frame, surface_.size().x(), interrupter);
        for (std::size_t i = 0; i < all.size(0); ++i) {
            add(all.triangle(0, i));
            if (all.counted(0, i)) counted_ = triangles_.size();
        }
        triangleTree_.insert(triangles_.begin(), triangles_.end());
        segmentTree_.insert(segments_.begin(), segments_.end());
        triangleTree_.build();
        segmentTree_.build();
    }

    BitGrid run()
    {
        touch();
        cross();
        Slab slab;
        slab.planes = {0, last_.x()};
        slab.rowsPerPlane = surface_.size().y();
        slab.wordsPerRow = surface_.wordsPerRow();
        slab.surface = surface_.words();
        for (int axis = 0; axis < 3; ++axis) slab.crossings[axis] = crossings_[axis].words();
        const std::size_t planeWords = surface_.rowOffset(1, 0);
        std::vector<BitGrid::Word> alongX(planeWords), leakingX(planeWords);
        const BitGrid::Word* crossings = slab.crossings[0];
        for (int x = 0; x <= last_.x(); ++x) {
            for (BitGrid::Word& word : leakingX) word ^= *crossings++;
        }
        voteInside(slab, alongX.data(), leakingX.data(), interrupter_);
        fillEnclosed(surface_, interrupter_);
        return std::move(surface_);
    }

private:
    /// Adds a triangle. CGAL's predicates need triangles and segments that are not degenerate.
    void add(const LatticeTriangle& triangle)
    {
        Point p[3];
        for (int i = 0; i < 3; ++i) {
            const openvdb::Vec3i& corner = triangle.corners[i];
            p[i] = Point(corner.x(), corner.y(), corner.z());
        }
        if (!CGAL::collinear(p[0], p[1], p[2])) {
            triangles_.emplace_back(p[0], p[1], p[2]);
            return;
        }
        std::sort(std::begin(p), std::end(p)); // along the line
        if (p[0] != p[2]) {
            segments_.emplace_back(p[0], p[2]);
        } else {
            points_.push_back(p[0]);
        }
    }

    /// Sets the touched voxels, block by block: no two blocks have words in common.
    void touch()
    {
        constexpr int size = 16;
        const tbb::blocked_range3d<int> blocks(0, last_.x() / size + 1, 1, 0, last_.y() / size + 1, 1, 0,
                                               last_.z() / 64 + 1, 1);
        parallelFor(
            blocks,
            [&](const tbb::blocked_range3d<int>& range) {
                throwIfInterrupted(interrupter_, 10);
                const Coord low(range.pages().begin() * size, range.rows().begin() * size, range.cols().begin() * 64);
                const Coord high(range.pages().end() * size, range.rows().end() * size, range.cols().end() * 64);
                touch(CoordBBox(low, Coord::minComponent(high.offsetBy(-1), last_)));
            },
            tbb::simple_partitioner());
        for (const Point& p : points_) {
            const auto voxels = [](double x) {
                const int at = static_cast<int>(x);
                return Span{(at - latticeBound + latticeStep - 1) >> latticeBits, (at + latticeBound) >> latticeBits};
            };
            const Span xs = voxels(p.x()), ys = voxels(p.y()), zs = voxels(p.z());
            for (const Coord& ijk : CoordBBox(xs.first, ys.first, zs.first, xs.last, ys.last, zs.last)) set(ijk);
        }
    }

    void touch(const CoordBBox& box)
    {
        const auto corner = [](const Coord& ijk, int offset) {
            return Point(ijk.x() * latticeStep + offset, ijk.y() * latticeStep + offset,
                         ijk.z() * latticeStep + offset);
        };
        const Kernel::Iso_cuboid_3 cuboid(corner(box.min(), -latticeBound), corner(box.max(), latticeBound));
        if (!triangleTree_.do_intersect(cuboid) && !segmentTree_.do_intersect(cuboid)) return;
        if (box.volume() == 1) {
            set(box.min());
            return;
        }
        CoordBBox halves[2] = {box, box};
        const std::size_t axis = box.maxExtent();
        halves[0].max()[axis] = (box.min()[axis] + box.max()[axis]) >> 1;
        halves[1].min()[axis] = halves[0].max()[axis] + 1;
        for (const CoordBBox& half : halves) touch(half);
    }

    void set(const Coord& ijk) { surface_.row(ijk.x(), ijk.y())[ijk.z() >> 6] |= BitGrid::Word(1) << (ijk.z() & 63); }

    /// Flips the voxels in which rays through voxel centres cross triangles.
    void cross()
    {
        parallelFor(0, last_.y() + 1, [&](int y) {
            throwIfInterrupted(interrupter_, 40);
            for (int z = 0; z <= last_.z(); ++z) crossAlong(0, {0, y, z});
        });
        parallelFor(0, last_.x() + 1, [&](int x) {
            throwIfInterrupted(interrupter_, 60);
            for (int z = 0; z <= last_.z(); ++z) crossAlong(1, {x, 0, z});
            for (int y = 0; y <= last_.y(); ++y) crossAlong(2, {x, y, 0});
        });
    }

    void crossAlong(std::size_t axis, Coord ijk)
    {
        const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        // Returns the ray at a distance of this many half voxels from the first centre.
        const auto at = [&](int halves) {
            double p[3] = {double(ijk.x()) * latticeStep, double(ijk.y()) * latticeStep, double(ijk.z()) * latticeStep};
            p[axis] = halves * (latticeStep / 2.0);
            return Point(p[0], p[1], p[2]);
        };
        const auto drop = [&](const Point& p) { return Point2(p[u], p[v]); };
        std::vector<TriangleBvh::Primitive_id> met;
        triangleTree_.all_intersected_primitives(Segment(at(-1), at(2 * last_[axis] + 1)), std::back_inserter(met));
        const Point2 centre = drop(at(0));
        for (const auto& id : met) {
            if (static_cast<std::size_t>(id - triangles_.cbegin()) >= counted_) continue;
            const Triangle& t = *id;
            if (!crosses(drop(t[0]), drop(t[1]), drop(t[2]), centre)) continue;
            const CGAL::Orientation before = CGAL::orientation(t[0], t[1], t[2], at(-3));
            // The first voxel whose far end is not before the triangle.
            int low = 0, high = last_[axis];
            while (low < high) {
                const int middle = (low + high) / 2;
                if (CGAL::orientation(t[0], t[1], t[2], at(2 * middle + 1)) == before) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            ijk[axis] = low;
            flip(crossings_[axis], ijk);
            ijk[axis] = 0;
        }
    }

    Interrupter* interrupter_;
    BitGrid surface_;
    const Coord last_;
    BitGrid crossings_[3];
    std::vector<Triangle> triangles_; ///< lattice units, counted from the centre of the grid's first voxel
    std::vector<Segment> segments_;   ///< of degenerate triangles
    std::vector<Point> points_;
    std::size_t counted_ = 0; ///< the crossings of this many triangles, the first ones, count
    TriangleBvh triangleTree_;
    SegmentTree segmentTree_;
};

} // namespace

BitGrid voxelizeCgal(const Mesh& model, const Frame& frame, Interrupter* interrupter)
{
    return CgalVoxelizer(model, frame, interrupter).run();
}

} // namespace vdbcage::detail
