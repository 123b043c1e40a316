#pragma once

#include <optional>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/BBox.h>
#include <openvdb/math/Coord.h>
#include <openvdb/math/Transform.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// The lattice units in a voxel. Models are voxelized on integers: the index-space coordinates in these units.
constexpr int latticeBits = 14;
constexpr int latticeStep = 1 << latticeBits;
/// Half the width of the cube that stands for a voxel: half a voxel and one unit. A point lies at most half a unit off
/// by its own rounding, and a quarter of a unit by that of the transform, together less than the added unit.
constexpr int latticeBound = latticeStep / 2 + 1;

/// The place of a model's voxels in the world. The centre of the model's bounding box is at the index resolution / 2 on
/// each axis. The longest side is `resolution` voxels long: its ends are at the indices 0 and `resolution`, each in the
/// middle of a voxel. The halves of a symmetric model get mirrored voxels.
struct Frame {
    openvdb::Vec3d center;     ///< of the model's bounding box, world space
    double voxelSize = 1;      ///< world units
    int resolution = 1;        ///< 1 to 4096
    openvdb::CoordBBox voxels; ///< every voxel that a face can touch, index space, inclusive
};

/// Returns the frame of `model`, or of a model with the bounding box `box`.
/// \pre `model` has passed requireUsable
/// \throw InputError `box` does not hold the model; the longest side is not in [1e-100, 1e100]; a voxel is smaller than
/// 2^-37 of the largest absolute coordinate
/// Cost: O(faces).
Frame makeFrame(const Mesh& model, int resolution, const std::optional<openvdb::BBoxd>& box = {});

/// Makes the transform from index space to world space: a uniform scale and a translation. It takes any voxel size,
/// including those below 1.44e-5, which OpenVDB's own constructors refuse.
openvdb::math::Transform::Ptr makeTransform(const Frame& frame);

/// Returns the points of `model` on the lattice, with coordinates in [0, resolution * latticeStep]. Points that no face
/// uses and that lie outside become any place in that range.
/// Cost: O(points).
std::vector<openvdb::Vec3i> latticePoints(const Mesh& model, const Frame& frame);

} // namespace vdbcage::detail
