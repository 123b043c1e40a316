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

/// The mirror image of a point in a plane.
inline Vec3d mirrored(const SymmetryPlane& plane, Vec3d p)
{
    p[plane.axis] = 2 * plane.offset - p[plane.axis];
    return p;
}

/// A guard's knowledge of the model.
///
/// It works in units in which the model's longest side is 1 to 2, so that no product of lengths leaves the range of
/// double. They are a power of two apart from the world's. With a plane of symmetry, what is said of the model is said
/// of its mirror image, too.
class GuardModel {
public:
    /// \throw InputError an unusable model; options out of range
    /// \throw Cancelled
    GuardModel(const Mesh& model, const GuardOptions& options, Interrupter* interrupter);

    /// From the world's units to these; exact, as is the way back.
    Vec3d scaled(const Vec3d& p) const;
    Vec3d unscaled(const Vec3d& p) const;
    double scale() const { return scale_; }
    /// `p` as it will be written.
    Vec3d rounded(const Vec3d& p) const;
    /// In these units. Only the side of the plane where coordinates are larger is kept, with what lies across it: no
    /// nearer part is on the other side.
    const std::optional<SymmetryPlane>& symmetry() const { return symmetry_; }
    /// The mirror image; exact if `p` is rounded.
    /// \pre there is a plane of symmetry
    Vec3d mirrored(const Vec3d& p) const { return detail::mirrored(*symmetry_, p); }
    /// Whether `triangle` keeps the clearance. If not, and `blocker` is set, that is the item of a face it comes too
    /// near to. `hint` is an item to try first, or TriangleBvh::none.
    bool clear(const Corners& triangle, std::uint32_t hint, std::uint32_t* blocker) const;
    /// Calls visit(corners) for every model triangle that `triangle` comes too near to, until it answers false.
    void forEachBlocker(const Corners& triangle, const std::function<bool(const Corners&)>& visit) const;
    /// Whether a part of the model may lie in `box`; only then swept() has to be asked.
    bool mayHoldPart(const Box& box) const;
    /// Whether a change sweeps over a part of the model: `surface` is the new star and the reversed old one.
    bool swept(const std::vector<Corners>& surface, const Box& box) const;

    const TriangleBvh& tree() const { return tree_; }
    /// In the world's units, with its mirror image.
    const openvdb::BBoxd& box() const { return box_; }
    double clearance() const { return clearance_; }
    double minSine() const { return minSine_; }
    /// The distances and angles that triangles of a surface keep between each other.
    ///
    /// TetGen, for one, merges triangles that meet under more than 179.9 degrees and triangulates them anew. It puts
    /// them up to some thousandths of their size away from where they were.
    const Spacing& spacing() const { return spacing_; }
    bool roundsToFloat() const { return roundsToFloat_; }

private:
    openvdb::BBoxd box_;
    TriangleBvh tree_;
    TriangleBvh parts_; // a point of each connected part, as a degenerate triangle
    double scale_ = 1, clearance_ = 0, minSine_ = 0;
    std::optional<SymmetryPlane> symmetry_;
    double step_ = 0; // across the plane coordinates are rounded to multiples of it
    bool roundsToFloat_ = false;
    Spacing spacing_;
};

const GuardModel& modelOf(const BoundingGuard& guard);

} // namespace vdbcage::detail
