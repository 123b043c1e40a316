#pragma once

#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/guard/move_limit.h>

/// Half-spaces that a vertex must stay in so that its triangles keep clear of obstacles on its way, to first order.
namespace vdbcage::detail {

/// The points with normal . point >= offset.
struct HalfSpace {
    Vec3d normal;
    double offset;
};

/// Adds the half-spaces of the first contacts with the model when corner 0 of `now` moves straight to `to`. Returns
/// whether there are any.
///
/// It adds at most one of each kind: vertex with face, edge with edge and, if `corner`, face with vertex.
bool addImpacts(const GuardModel& guard, const Corners& now, const Vec3d& to, bool corner, double clearance,
                std::vector<HalfSpace>& halfSpaces);

/// Adds the half-space of the places of corner 0 of `star`, now at `at`, that keep `star` at least `clearance` from
/// `other`. Adds none if they cross.
void addApproach(const Corners& star, const Corners& other, const Vec3d& at, double clearance,
                 std::vector<HalfSpace>& halfSpaces);

/// Adds the half-space of the places within a limit's radius, if `to` is not.
void addReach(const MoveLimit& limit, const Vec3d& to, std::vector<HalfSpace>& halfSpaces);

/// Makes half-spaces those of a plane across an axis, for a vertex that moves in it.
void restrictToPlane(int axis, double offset, std::vector<HalfSpace>& halfSpaces);

} // namespace vdbcage::detail
