#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// All voxels whose centre lies in the convex hull of the active voxels of `mask`, each a whole cube, or within 1e-7
/// of it; so the result is connected by faces. Same transform, no other metadata; empty for an empty mask. Serial, O(a
/// + xy * f): a active voxels, a bounding box of x by y by z, f facets; 8 bytes for each of its x by y columns. \throw
/// Cancelled, Error (an extent of more than 2^20 voxels, or 2^28 columns) Based on: Barber, Dobkin, Huhdanpaa, The
/// Quickhull Algorithm for Convex Hulls, 1996 (libqhull).
VDBCAGE_API openvdb::MaskGrid::Ptr convexHull(const openvdb::MaskGrid& mask, Interrupter* interrupter = nullptr);

} // namespace vdbcage
