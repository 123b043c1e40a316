#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Makes a solid well-composed by adding voxels only. The boundary of the result is a 2-manifold.
///
/// Where two active voxels meet only in an edge or a corner, a voxel between them is added; also where two inactive
/// ones do in an active neighbourhood. This is repeated until there is no such place. Tiles stay tiles where nothing is
/// added. The order of voxels and threads does not matter.
/// \param solid any transform; active voxels in [-2^30, 2^30)
/// \param interrupter asked whether to stop; may be null
/// \throw InputError as extractSurface(), except for the transform and the quads
/// \throw Cancelled when the interrupter asks to stop
/// Based on: Latecki, 3D Well-Composed Pictures, 1997.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> makeWellComposed(const openvdb::MaskGrid& solid,
                                                                Interrupter* interrupter = nullptr);

/// Returns the boundary of makeWellComposed() as quads in world space, one for each face between an active and an
/// inactive voxel.
///
/// It is closed, 2-manifold at edges and vertices, and faces outward. Its order is deterministic. It is empty for an
/// empty grid.
/// \param solid a linear transform; active voxels in [-2^30, 2^30)
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when the transform or a coordinate is not so; there are more than 10^8 quads, or 2^22 blocks of
/// 8^3 voxels at the surface; there are active tiles, and the leaf nodes and the outer layers of tiles have more than
/// 2^26 such blocks
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API Mesh extractSurface(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

} // namespace vdbcage
