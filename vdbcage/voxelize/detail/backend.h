#pragma once

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/frame.h>

namespace vdbcage::detail {

/// What every voxelizer is: the solid voxels of `model`, as voxelize() defines them, in a grid over `frame.voxels`.
/// `model` has passed requireUsable, `frame` is makeFrame's. \throw DeviceError, Cancelled
using Backend = BitGrid(const Mesh& model, const Frame& frame, Interrupter* interrupter);

Backend voxelizeCpu;

/// Through an OpenGL context of its own, that lives as long as the call.
Backend voxelizeGl;

/// By CGAL's predicates and AABB tree: slow, and of other make. \throw DeviceError in builds without
/// VDBCAGE_WITH_CGAL_GPL
Backend voxelizeCgal;

} // namespace vdbcage::detail
