#pragma once

#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::edit {

/// Carries poses over from one cage to another: returns the points of `other` for each of `poses` of the points of
/// `rest`.
///
/// A point of `other` at the place of a point of `rest` that faces use gets that one's posed place bit for bit; of
/// several, the first one's. The other points ride on `rest` by mean value coordinates. If no point that faces use has
/// moved, all of `other` stays bit for bit.
/// \pre `rest` faces outward
/// \throw InputError not one posed point for each of `rest`; a point not finite; `rest` is not closed, faces inward or
/// is flat
/// \throw Cancelled
/// Cost: O(points of `other` x (faces of `rest` + poses x points of `rest`)), in parallel except for the second part.
/// The result is the same for any number of threads.
std::vector<std::vector<openvdb::Vec3d>> carriedPoses(const Mesh& rest,
                                                      const std::vector<std::vector<openvdb::Vec3d>>& poses,
                                                      const Mesh& other, Interrupter* interrupter = nullptr);

} // namespace vdbcage::edit
