#pragma once

#include <vector>

#include <tools/edit/elements.h>

namespace vdbcage::edit {

/// Returns the coordinate on the other side of a plane: 2 * place - x, rounded to double.
double mirroredCoordinate(double x, double place);

/// Returns for each point its counterpart across the plane where coordinate `axis` (0 to 2) is `place`: the point at
/// exactly its mirror image (see mirroredCoordinate), itself if it lies on the plane, `none` if there is no such point.
///
/// Partners are mutual. If there are several points at one place, and as many at the other, the first ones are
/// partners, and so on. Points that are not finite have none.
/// \throw InputError `axis` out of range, `place` not finite
/// Cost: O(n log n).
std::vector<Index> mirrorPartners(const std::vector<openvdb::Vec3d>& points, int axis, double place);

/// Returns the points `after` a motion, made symmetric where the motion touched them. `moved` are the points that it
/// may have moved, `before` are the places of all.
///
/// The partner of each moved point gets its exact mirror image. A moved point that is its own partner is put on the
/// plane. If a point and its partner were both moved, the one with the larger coordinate along `axis` before the motion
/// leads; of equal ones the one with the smaller index. All other points stay as they are `after`.
///
/// The coordinate of a leading point may be rounded, by the last bit of its old value or of `place`, so that each of
/// the pair is the exact mirror image of the other.
/// \pre `moved` and `partners` are indices of points, or `none`; `partners` are mutual
/// \throw InputError `before`, `after` and `partners` have different sizes; `axis` out of range, `place` not finite
/// Cost: O(n).
std::vector<openvdb::Vec3d> mirrored(const std::vector<openvdb::Vec3d>& before, std::vector<openvdb::Vec3d> after,
                                     const std::vector<Index>& moved, const std::vector<Index>& partners, int axis,
                                     double place);

} // namespace vdbcage::edit
