#pragma once

#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// The integers from `first` to `last`; none if last < first.
struct Span {
    int first = 0, last = -1;
    bool empty() const { return last < first; }
    bool contains(int i) const { return first <= i && i <= last; }
};

/// The corners of a triangle in lattice units (see frame.h), counted from the centre of voxel (0, 0, 0) of the grid.
struct LatticeTriangle {
    openvdb::Vec3i corners[3];
};

/// The planes `planes` of a grid of bits, packed as in BitGrid, for the results of scanSurface.
struct Slab {
    Span planes;                      ///< x
    int rowsPerPlane = 0;             ///< the grid's size along y
    int wordsPerRow = 0;              ///< along z
    std::uint64_t* surface = nullptr; ///< voxels that a triangle touches
    std::uint64_t* crossings[3] = {}; ///< voxels where the ray along x, y, z is crossed an odd number of times
    std::uint8_t* crossed = nullptr;  ///< by row: bit `axis` is set if crossings[axis] was written there
};

/// Buffer of scanSurface, to be kept from call to call.
using ScanBuffer = std::vector<Span>;

/// Sets, in the slab's `surface`, the voxels that the triangle touches: those whose cube, of half width latticeBound,
/// meets it.
///
/// With `counted` it also flips, in `crossings`, the voxels in which the triangle crosses a ray through voxel centres
/// along each axis: those that contain the points of crossing. All is exact. Degenerate triangles are segments and
/// points: they cross no ray, and touch the same voxels as these. Returns the number of columns examined, as a measure
/// of the work.
/// \pre everything that the triangle touches lies in the grid's rows
/// Cost: O(columns of the triangle's box in the slab).
std::size_t scanSurface(const LatticeTriangle& triangle, bool counted, const Slab& slab, ScanBuffer& buffer);

/// Finds the crossings along x of all `planes` together: flips (y, z) in `plane` where scanSurface would flip an odd
/// number of times.
/// Cost: O(rows of the triangle's box).
void scanCrossingsAlongX(const LatticeTriangle& triangle, const Span& planes, std::uint64_t* plane, int wordsPerRow);

} // namespace vdbcage::detail
