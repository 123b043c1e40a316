#pragma once

#include <memory>
#include <optional>
#include <string>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/voxelize/interior.h>

namespace vdbcage {

/// Which code turns the model into voxels. All of them are exact and give the same bits.
enum class Voxelizer {
    automatic, ///< gl at resolution 1024 and above if there is hardware for it and it does not fail, else cpu
    cpu,       ///< TBB-parallel; the reference
    gl,        ///< OpenGL 4.5 shaders, in software where there is no hardware; needs no display
    cgal       ///< CGAL's AABB tree, TBB-parallel; slow; optional GPL part
};

/// How voxelize() makes voxels.
struct VoxelizeOptions {
    static constexpr Range resolutions{1, 4096}; ///< of `resolution`

    int resolution = 128;                       ///< voxels along the model's longest side
    Voxelizer voxelizer = Voxelizer::automatic; ///< decides on time and memory only: all give the same bits
    /// The voxels are laid out as for a model with this bounding box, which must hold the model's own; unset: that one.
    std::optional<openvdb::BBoxd> box = {};
    Interior interior = Interior::solid; ///< of a model with holes; closed models are the same whatever it is
};

/// How voxelize() did it.
struct VoxelizeReport {
    Voxelizer voxelizer = Voxelizer::cpu; ///< whose voxels these are, never automatic
    std::string fallback = {};            ///< why automatic took cpu after it had tried gl; else empty
    Interior interior = Interior::solid;  ///< as asked for or found, never automatic
    std::optional<double> agreement = {}; ///< rayAgreement() of the model, if it was automatic
};

/// The result of voxelize().
struct Voxelization {
    std::shared_ptr<openvdb::MaskGrid>
        mask;              ///< the solid is its active voxels; its transform says where they lie in the world
    VoxelizeReport report; ///< how they were made
};

/// Turns any polygon soup into a solid: the voxels that a face touches, and those inside.
///
/// \par Where the voxels are
/// Voxel ijk is the unit cube centred at ijk in index space; the voxel size is the longest side
/// of the model's bounding box divided by the resolution, and the transform of the grid, a uniform scale and a
/// translation, says where it lies. The centre of the bounding box is at the index resolution / 2 on each axis, so the
/// ends of the longest side are at 0 and `resolution`, in the middle of a voxel: that side gets resolution + 1 voxels,
/// all indices are in [0, resolution], and a model with a plane of symmetry across an axis through its middle gets
/// mirrored voxels. Moving or scaling the model moves or scales the transform and, but for rounding, changes no voxel.
///
/// \par What is touched
/// The model is rounded to a lattice of 2^-14 voxel and cubes are grown by one lattice unit on each
/// side, more than the rounding can amount to. On these integers the answer is exact; so every voxel is set whose
/// closed cube meets a face of the model as given, and none whose cube is farther than 2^-12 voxel from all of them.
/// Quads count under both diagonals; degenerate faces count as the segments and points that they are.
///
/// \par What is inside
/// A voxel whose centre is an odd number of crossings away from both ends of the rays along at least
/// two of the three axes (a quad counts under its diagonal 0-2); and then every voxel that no path of face-connected
/// voxels neither touched nor inside joins to the outside, so the solid has no cavities. Orientation plays no part.
/// Open, self-intersecting and multi-part models become solids too: a bowl is filled to its rim; a sheet has no inside.
/// With Interior::shell the rays have no say, so that a bowl is its wall.
///
/// \throw InputError the resolution is out of range; what requireUsable() refuses; the box does not hold the model, or
///        its longest side is not in [1e-100, 1e100]; a voxel is smaller than 2^-37 (7e-12) of the largest absolute
///        coordinate, so that a model far from the origin has no room for its digits
/// \throw DeviceError there is no OpenGL 4.5 or it fails; cgal is not in this build; never with automatic and cpu
/// \throw Cancelled
///
/// Cost: O(faces + touched voxels + box / 64) time, where box is the number of voxels of the bounding box, at most
/// (resolution + 1)^3; box / 7 bytes and a few planes a thread, up to box / 5 bytes more where much of the box is
/// hidden in hollows; gl also needs 128 MiB of the device and as much again. TBB-parallel; the result does not depend
/// on the number of threads.
///
/// The transform can have a voxel size below 1.44e-5, the smallest that OpenVDB's own constructors take; functions of
/// OpenVDB that build a new map from it (getAffineMap, postTranslate) throw ArithmeticError for such a grid.
///
/// Based on: Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001; Schwarz and Seidel, Fast Parallel Surface and
/// Solid Voxelization on GPUs, 2010; Nooruddin and Turk, Simplification and Repair of Polygonal Models Using
/// Volumetric Techniques, 2003 (votes of parity counts).
VDBCAGE_API Voxelization voxelize(const Mesh& model, const VoxelizeOptions& options = {},
                                  Interrupter* interrupter = nullptr);

} // namespace vdbcage
