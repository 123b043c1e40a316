#pragma once

#include <cstddef>
#include <cstdint>

#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

struct BoundaryTopology {
    std::size_t components = 0; ///< separate surfaces, inner ones too
    std::int64_t genus = 0;     ///< handles of all of them
};

/// The findings of analyzeTopology in extractSurface(solid), without the mesh: by Euler's formula.
/// \throw InputError as makeWellComposed; more than 10^8 quads
/// \throw Cancelled
/// Cost: O(voxels at the surface), and 4 bytes a point.
BoundaryTopology boundaryTopology(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
