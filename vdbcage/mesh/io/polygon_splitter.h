#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// A splitter of faces of four and more corners into triangles that keep the face's orientation. It never adds, moves
/// or drops corners.
///
/// It decides in rounded arithmetic. Every choice of diagonals fills the same loop of edges, so a rounding error can at
/// most choose a worse diagonal in a face that is nearly degenerate.
class PolygonSplitter {
public:
    /// `points` must outlive the splitter and not change.
    explicit PolygonSplitter(const std::vector<openvdb::Vec3d>& points) : points_(points) {}

    /// Appends `count` - 2 triangles, or the face itself to `quads`. A face of four corners goes to `quads` if it is
    /// convex, or if no diagonal divides it well (it crosses itself or has no area).
    /// Cost: O(count log count) for most faces. For large `count` the work is bounded by a multiple of `count`; the
    /// rest of the face is then split as if it had no right division.
    void split(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles,
               std::vector<openvdb::Vec4I>& quads);

    /// Appends the triangles of ear clipping, even where split() takes a fan.
    void splitByEars(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles);

    /// Returns the cost of the search for ears in the faces split so far: about the number of corners examined, and 0
    /// for fans.
    std::size_t work() const { return allWork_; }

private:
    struct Box {
        double left, right, bottom, top;
    };
    struct Node {
        Box box;
        std::size_t left; ///< obstacles in it that are not clipped yet
    };
    struct Corner {
        double x, y;
        std::size_t previous, next;
        std::size_t round;     ///< the round of clipping in which its turn comes
        std::size_t node;      ///< the leaf of the tree of obstacles that has it
        bool clipped, pointed; ///< pointed: its angle is below 180 degrees
    };

    void splitQuad(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles,
                   std::vector<openvdb::Vec4I>& quads);
    void project();
    double area(std::size_t a, std::size_t b, std::size_t c) const;
    bool isFanApex(std::size_t apex) const;
    void fan(const openvdb::Index32* face, std::size_t apex, std::vector<openvdb::Vec3I>& triangles) const;
    void fold(const openvdb::Index32* face, std::size_t corner, std::size_t left,
              std::vector<openvdb::Vec3I>& triangles);
    void clipEars(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles);
    void clip(std::size_t corner, const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles);
    bool isEar(std::size_t corner);
    bool isBlocked(std::size_t corner, const Box& box, std::size_t node, std::size_t begin, std::size_t end);
    bool mayOverlap(std::size_t corner, const Box& box, const Box& other) const;
    void growTree(std::size_t node, std::size_t begin, std::size_t end);
    void dropObstacle(std::size_t corner);

    const std::vector<openvdb::Vec3d>& points_;
    std::vector<openvdb::Vec3d> local_; // the face's corners, scaled to about 1
    std::vector<Corner> loop_;          // the same, projected

    // The corners that may lie in an ear, as a tree: node i has a range of them, node 2 i + 1 the first half of that
    // range, node 2 i + 2 the second.
    std::vector<std::size_t> obstacles_;
    std::vector<Node> nodes_;
    std::vector<std::size_t> candidates_, nextCandidates_; // the corners to examine in this round and the next
    std::size_t round_ = 0;
    std::size_t allWork_ = 0;
    std::size_t work_ = 0; // the cost of ears in this face
};

/// Appends the fan around the first corner of a face, as most programs split it.
void addFirstFan(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles);

/// The largest number of corners of a face with alternate splits.
constexpr std::size_t mostCornersWithAlternates = 64;

/// Appends the triangles of other splits of a face of four or more corners than that of PolygonSplitter. Up to eight
/// corners these are any three corners; up to 64, the fans around each. Larger faces have none.
void addAlternatives(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles);

/// Returns the number of triangles that addAlternatives() appends for a face of `count` corners.
std::size_t alternativesOf(std::size_t count);

} // namespace vdbcage::detail
