#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/geometry/triangle_bvh.h>
#include <vdbcage/geometry/triangle_distance.h>
#include <vdbcage/geometry/triangle_pair.h>

namespace vdbcage::detail {

/// Returns the mirror image of a point in a plane.
inline Vec3d mirrored(const SymmetryPlane& plane, Vec3d p)
{
    p[plane.axis] = 2 * plane.offset - p[plane.axis];
    return p;
}

/// The model as a guard sees it.
///
/// Lengths are in units in which the model's longest side is 1 to 2, so that no product of lengths leaves the range of
/// double. They are the world's units times a power of two. With a plane of symmetry, the model includes its mirror
/// image.
class GuardModel {
public:
    /// \throw InputError an unusable model; options out of range
    /// \throw Cancelled
    GuardModel(const Mesh& model, const GuardOptions& options, Interrupter* interrupter);

    /// Converts from the world's units to these, exactly; unscaled() converts back, exactly.
    Vec3d scaled(const Vec3d& p) const;
    Vec3d unscaled(const Vec3d& p) const;
    double scale() const { return scale_; }
    /// Returns `p` as it will be written.
    Vec3d rounded(const Vec3d& p) const;
    /// Returns the plane of symmetry in these units. tree() holds the triangles on its side of larger coordinates and
    /// those across it; none on the other side are nearer.
    const std::optional<SymmetryPlane>& symmetry() const { return symmetry_; }
    /// Returns the mirror image; exact if `p` is rounded.
    /// \pre there is a plane of symmetry
    Vec3d mirrored(const Vec3d& p) const { return detail::mirrored(*symmetry_, p); }
    /// Returns whether `triangle` keeps the clearance. If not, sets `blocker`, if given, to the item of a face that it
    /// comes too near to. `hint` is an item to try first, or TriangleBvh::none.
    bool clear(const Corners& triangle, std::uint32_t hint, std::uint32_t* blocker) const;
    /// Calls visit(corners) for every model triangle that `triangle` comes too near to, until it returns false.
    void forEachBlocker(const Corners& triangle, const std::function<bool(const Corners&)>& visit) const;
    /// Returns whether a part of the model may lie in `box`; if not, swept() is false.
    bool mayHoldPart(const Box& box) const;
    /// Returns whether a change sweeps over a part of the model: `surface` is the new star and the reversed old one.
    bool swept(const std::vector<Corners>& surface, const Box& box) const;

    const TriangleBvh& tree() const { return tree_; }
    /// Returns a point of each connected part, as a degenerate triangle.
    const TriangleBvh& parts() const { return parts_; }
    /// Returns the bounding box in the world's units, with its mirror image.
    const openvdb::BBoxd& box() const { return box_; }
    double clearance() const { return clearance_; }
    double minSine() const { return minSine_; }
    /// Returns the distances and angles that triangles of a surface keep between each other.
    ///
    /// TetGen, for example, merges triangles that meet at more than 179.9 degrees and triangulates them again, which
    /// moves them by up to some thousandths of their size.
    const Spacing& spacing() const { return spacing_; }
    bool roundsToFloat() const { return roundsToFloat_; }

private:
    openvdb::BBoxd box_;
    TriangleBvh tree_;
    TriangleBvh parts_; // a point of each connected part, as a degenerate triangle
    double scale_ = 1, clearance_ = 0, minSine_ = 0;
    std::optional<SymmetryPlane> symmetry_;
    double step_ = 0; // coordinates across the plane are rounded to multiples of it
    bool roundsToFloat_ = false;
    Spacing spacing_;
};

} // namespace vdbcage::detail
