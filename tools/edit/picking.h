#pragma once

#include <optional>
#include <vector>

#include <openvdb/math/Vec2.h>
#include <tools/draw/camera.h>
#include <tools/draw/geometry.h>
#include <tools/draw/renderer.h>
#include <tools/edit/elements.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::edit {

/// A model that is drawn solid and hides parts of a cage. Make it once for each model and pose.
class Occluder {
public:
    /// Cost: O(n log n), in parallel: some 0.3 us per triangle.
    explicit Occluder(const draw::Geometry& geometry);

private:
    friend class Picking;
    detail::TriangleBvh tree_;
};

/// The view of a cage.
struct PickView {
    draw::Eye eye;
    double width = 1, height = 1;         ///< of the panel, in pixels; > 0
    std::optional<draw::Section> section; ///< parts that it cuts off are neither picked nor hide anything
    bool seeThrough = false;              ///< nothing hides anything
};

/// A search for the elements of a cage at places of a panel, which is how users point at them.
///
/// Places are in pixels, x to the right and y down from the panel's upper left corner. Points nearer than Eye::nearest
/// are not drawn, so they are not found. A point less than 1e-6 (drawing coordinates) behind a face is not hidden by
/// it. Ties go to the smaller index.
class Picking {
public:
    /// `points` are the cage's, in drawing coordinates. `occluder` may be null; else it must outlive this object, as
    /// must `elements`.
    /// \throw InputError not one point for each of `elements`, or one that faces use is not finite
    /// Cost: O(n log n).
    Picking(const Elements& elements, std::vector<openvdb::Vec3d> points, const PickView& view,
            const Occluder* occluder = nullptr);

    /// Returns the element that a user means by a click.
    ///
    /// Points and edges: the nearest of those that are visible and at most `radius` pixels away; of equal ones the one
    /// in front. An edge counts by its point that looks nearest to the click: that one must be visible. Faces other
    /// than the element's own may hide it. Faces: the first that is drawn there, from either side; `radius` does not
    /// matter, and only the occluder can hide it.
    /// Cost: O(n), and O(log n) for each of the nearest until one is visible.
    std::optional<Index> at(Element kind, double x, double y, double radius) const;

    /// Returns the elements in a polygon, which may cross itself (even-odd rule), such as a box or a lasso; ascending.
    ///
    /// Points: they are inside and visible. Edges: both ends are inside, and the middle is visible. Faces: the mean of
    /// the corners is inside and visible.
    /// Cost: O(n m) for m corners, and O(log n) for each element inside.
    std::vector<Index> within(Element kind, const std::vector<openvdb::Vec2d>& polygon) const;

private:
    /// A point on the cage that is neither cut off nor too near.
    struct Spot {
        openvdb::Vec3d point;
        openvdb::Vec2d pixel;
        double depth;
    };
    struct Candidate;

    bool isCut(const openvdb::Vec3d& point) const;
    std::optional<Spot> spotAt(const openvdb::Vec3d& point) const;
    std::optional<Spot> spotOnEdge(Index edge, const openvdb::Vec2d& pixel) const;
    std::optional<Spot> middleOf(Element kind, Index id) const;
    Ids facesAt(Element kind, const Index& id) const;
    template <typename IsOwn>
    bool isBehind(const detail::TriangleBvh& tree, const openvdb::Vec3d& from, const openvdb::Vec3d& to,
                  const IsOwn& isOwn) const;
    bool isBehindOccluder(const openvdb::Vec3d& from, const openvdb::Vec3d& to) const;
    bool isHidden(const Spot& spot, Ids own) const;
    openvdb::Vec3d startTowards(const Spot& spot) const;
    std::optional<Index> faceAt(const openvdb::Vec2d& pixel) const;

    const Elements& elements_;
    std::vector<openvdb::Vec3d> points_;
    PickView view_;
    const Occluder* occluder_;
    detail::TriangleBvh tree_;          ///< of the cage's faces
    std::vector<Index> faceOfTriangle_; ///< in `tree_`
};

} // namespace vdbcage::edit
