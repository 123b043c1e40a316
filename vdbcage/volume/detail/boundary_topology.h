#pragma once

#include <cstddef>
#include <cstdint>

#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

struct BoundaryTopology {
    std::size_t components = 0; ///< separate surfaces, inner ones too
    std::int64_t genus = 0;     ///< tunnels through all of them
};

/// Returns the same components and genus as analyzeTopology of extractSurface(solid), by Euler's formula, without
/// making the mesh.
/// \throw InputError as makeWellComposed; more than 10^8 quads
/// \throw Cancelled
/// Cost: O(voxels at the surface), and 4 bytes a point.
BoundaryTopology boundaryTopology(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
