#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// `solid` made well-composed by adding voxels only: where two active voxels meet in nothing but an edge or a corner,
/// or two inactive ones in an active neighbourhood do, a voxel between them is added, repeated until there is no such
/// place. The boundary of the result is a 2-manifold. Tiles stay tiles where nothing is added. Does not depend on the
/// order of voxels or threads.
/// \throw InputError as extractSurface, but for the transform; Cancelled
/// Based on: Latecki, 3D Well-Composed Pictures, 1997.
VDBCAGE_API openvdb::MaskGrid::Ptr makeWellComposed(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

/// The boundary of makeWellComposed(solid) as quads, one for each face between an active and an inactive voxel, in
/// world space: closed, 2-manifold at edges and vertices, facing outward. Deterministic order; empty for an empty
/// grid. \throw InputError (transform is not linear, active voxels beyond 2^30, more than 10^8 quads), Cancelled
VDBCAGE_API Mesh extractSurface(const openvdb::MaskGrid& solid, Interrupter* interrupter = nullptr);

} // namespace vdbcage
