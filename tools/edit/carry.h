#pragma once

#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::edit {

/// Poses of another cage: where the points of `other` are when those of `rest` are at each of `poses`.
///
/// A point of `other` that is at a point of `rest` which faces use gets that one's posed place bit for bit, of several
/// the first one's. The other points ride on `rest` by mean value coordinates. Where no point that faces use has moved,
/// all of `other` stays bit for bit.
/// \pre `rest` faces outward
/// \throw InputError not one posed point for each of `rest`; a point not finite; `rest` is not closed, faces inward or
/// is flat
/// \throw Cancelled
/// Cost: O(points of `other` x (faces of `rest` + poses x points of `rest`)), in parallel but for the second part. The
/// same for any number of threads.
std::vector<std::vector<openvdb::Vec3d>> carriedPoses(const Mesh& rest,
                                                      const std::vector<std::vector<openvdb::Vec3d>>& poses,
                                                      const Mesh& other, Interrupter* interrupter = nullptr);

} // namespace vdbcage::edit
