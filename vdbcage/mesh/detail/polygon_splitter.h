#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Splits faces of four and more corners into triangles that keep the face's orientation. It decides in rounded
/// arithmetic: every choice of diagonals fills the same loop of edges, so an error of rounding can at worst choose a
/// worse diagonal in a face that is nearly degenerate. Corners are never added, moved or dropped.
class PolygonSplitter {
public:
    /// `points` must outlive the splitter and not change.
    explicit PolygonSplitter(const std::vector<openvdb::Vec3d>& points) : points_(points) {}

    /// Appends `count` - 2 triangles, or the face itself to `quads` if it has four corners and is convex, or if no
    /// diagonal divides it well (it crosses itself or has no area). Cost: O(count) for a convex face, at worst
    /// O(count^2).
    void split(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles,
               std::vector<openvdb::Vec4I>& quads);

private:
    struct Corner {
        double x, y;
        std::size_t previous, next;
        std::size_t round;     ///< of clipping, in which its turn comes
        bool clipped, pointed; ///< pointed: its angle is below 180 degrees
    };

    void splitQuad(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles,
                   std::vector<openvdb::Vec4I>& quads);
    void project();
    double area(std::size_t a, std::size_t b, std::size_t c) const;
    bool isFanApex(std::size_t apex) const;
    void fan(const openvdb::Index32* face, std::size_t apex, std::vector<openvdb::Vec3I>& triangles) const;
    void clipEars(const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles);
    void clip(std::size_t corner, const openvdb::Index32* face, std::vector<openvdb::Vec3I>& triangles);
    bool isEar(std::size_t corner) const;
    void sortObstacles();
    std::size_t cellIndex(double distance) const;

    const std::vector<openvdb::Vec3d>& points_;
    std::vector<openvdb::Vec3d> local_; // the face's corners, scaled to about 1
    std::vector<Corner> loop_;          // the same, projected

    // The corners that may lie in an ear, sorted into side_ x side_ cells over the face: cell c has those of obstacles_
    // from cellBegin_[c] to cellBegin_[c + 1].
    std::vector<std::size_t> obstacles_, cellBegin_;
    std::size_t side_ = 1;
    std::vector<std::size_t> candidates_, nextCandidates_; // the corners to look at in this round and the next
    std::size_t round_ = 0;
    double cellX_ = 0, cellY_ = 0, cellsPerUnit_ = 0;
};

/// Appends the triangles of other ways to split a face of four or more corners than the one that a PolygonSplitter
/// chooses: any three corners up to eight; beyond, up to 64 corners, the fans around each; nothing for larger faces.
void addAlternatives(const openvdb::Index32* face, std::size_t count, std::vector<openvdb::Vec3I>& triangles);

} // namespace vdbcage::detail
