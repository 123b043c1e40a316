#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Which code turns the model into voxels. All of them give the same bits on closed models.
enum class Voxelizer {
    automatic, ///< the fastest of those that this build and machine have
    cpu,       ///< exact, TBB-parallel; the reference
    gl,        ///< OpenGL 4.5 shaders
    cgal       ///< CGAL, optional GPL part
};

struct VoxelizeOptions {
    int resolution = 128; ///< voxels along the model's longest side, 1 to 4096
    Voxelizer voxelizer = Voxelizer::automatic;
};

/// Turns any polygon soup into a solid: the voxels whose closed cube meets a face, and those inside.
///
/// Voxel ijk is the unit cube centred at ijk in index space; the voxel size is the longest side of the model's
/// bounding box divided by the resolution, and the transform of the grid says where it lies. Faces are taken with
/// their points rounded to a lattice of 2^-14 voxel and cubes grown by as much, so that no voxel that a face of the
/// unrounded model touches is ever missed. A voxel is inside if rays along at least two of the three axes through its
/// centre cross the surface an odd number of times, or if no path of face-connected empty voxels joins it to the
/// outside; so open, self-intersecting, badly oriented and multi-part models become solids too. Quads count under
/// both diagonals.
///
/// \throw InputError an empty or non-finite model, a resolution out of range, a model too small for its distance from
///        the origin; DeviceError the chosen voxelizer is not to be had; Cancelled
/// Cost: O(faces + surface voxels + resolution^3 / 64) time, resolution^3 / 4 bytes of memory (grid and flood).
/// Based on: Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001; Schwarz and Seidel, Fast Parallel Surface and
/// Solid Voxelization on GPUs, 2010; Nooruddin and Turk, Simplification and Repair of Polygonal Models Using
/// Volumetric Techniques, 2003 (votes of parity counts).
VDBCAGE_API openvdb::MaskGrid::Ptr voxelize(const Mesh& model, const VoxelizeOptions& options = {},
                                            Interrupter* interrupter = nullptr);

} // namespace vdbcage
