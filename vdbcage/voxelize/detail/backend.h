#pragma once

#include <utility>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/frame.h>
#include <vdbcage/voxelize/voxelize.h>

namespace vdbcage::detail {

/// The type of every voxelizer, which makes the solid voxels of `model`, as voxelize() defines them, in a grid over
/// `frame.voxels`.
/// \pre `model` has passed requireUsable, and `frame` is makeFrame's
/// \throw DeviceError
/// \throw Cancelled
using Backend = BitGrid(const Mesh& model, const Frame& frame, Interrupter* interrupter);

Backend voxelizeCpu;

/// Uses an OpenGL context of its own that lives as long as the call.
Backend voxelizeGl;

/// Does the same, but only with a hardware context.
/// \throw DeviceError also if there is none
Backend voxelizeGlHardware;

/// Uses CGAL's predicates and AABB tree: slow, and independent of the others.
/// \throw DeviceError in builds without VDBCAGE_WITH_CGAL_GPL
Backend voxelizeCgal;

/// The least resolution for which setting up a device may pay. Below, the CPU is done before a context and its shaders
/// are made (VOXELIZERS.md).
constexpr int leastResolutionForDevice = 1024;

/// Voxelizes with the device from leastResolutionForDevice on, unless it fails; else with the CPU. The report has the
/// choice and the reason.
std::pair<BitGrid, VoxelizeReport> voxelizeAutomatically(const Mesh& model, const Frame& frame, Backend& device,
                                                         Interrupter* interrupter);

} // namespace vdbcage::detail
