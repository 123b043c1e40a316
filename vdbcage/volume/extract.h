#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// `solid` made well-composed by adding voxels only. The boundary of the result is a 2-manifold.
///
/// Where two active voxels meet in nothing but an edge or a corner, a voxel between them is added. So it is where two
/// inactive ones do in an active neighbourhood. This is repeated until there is no such place. Tiles stay tiles where
/// nothing is added. The order of voxels and threads does not matter.
/// \throw InputError as extractSurface, but for the transform and the quads
/// \throw Cancelled
/// Based on: Latecki, 3D Well-Composed Pictures, 1997.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> makeWellComposed(const openvdb::MaskGrid& solid,
                                                                Interrupter* interrupter = nullptr);

/// The boundary of makeWellComposed(solid) as quads in world space, one for each face between an active and an inactive
/// voxel.
///
/// It is closed, 2-manifold at edges and vertices, and faces outward. Its order is deterministic. It is empty for an
/// empty grid.
/// \throw InputError a transform that is not linear; active voxels outside [-2^30, 2^30); more than 10^8 quads, or 2^22
/// blocks of 8^3 voxels at the surface; active tiles where the leaf nodes and the outer layers of tiles have more than
/// 2^26 blocks of 8^3 voxels
/// \throw Cancelled
VDBCAGE_API Mesh extractSurface(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

} // namespace vdbcage
