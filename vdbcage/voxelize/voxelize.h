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

/// The code that turns the model into voxels. All of them are exact and make the same bits.
enum class Voxelizer {
    automatic, ///< gl at resolution 1024 and above if there is hardware for it and it does not fail, else cpu
    cpu,       ///< TBB-parallel; the reference
    gl,        ///< OpenGL 4.5 shaders, in software where there is no hardware; needs no display
    cgal       ///< CGAL's AABB tree, TBB-parallel; slow; optional GPL part
};

/// The options of voxelize().
struct VoxelizeOptions {
    static constexpr Range resolutions{1, 4096}; ///< of `resolution`

    int resolution = 128;                       ///< length of the model's longest side, in voxels
    Voxelizer voxelizer = Voxelizer::automatic; ///< decides on time and memory only: all make the same bits
    /// The voxels are laid out as for a model with this bounding box, which must hold the model's own; unset: that one.
    /// World units.
    std::optional<openvdb::BBoxd> box = {};
    Interior interior = Interior::solid; ///< of a model with holes; closed models are the same whatever it is
};

/// The choices that voxelize() made.
struct VoxelizeReport {
    Voxelizer voxelizer = Voxelizer::cpu; ///< whose voxels these are, never automatic
    std::string fallback = {};            ///< why automatic took cpu after it had tried gl; else empty
    Interior interior = Interior::solid;  ///< as asked for or found, never automatic
    std::optional<double> agreement = {}; ///< rayAgreement() of the model, if `interior` was automatic
};

/// The result of voxelize().
struct Voxelization {
    std::shared_ptr<openvdb::MaskGrid>
        mask;              ///< the solid is its active voxels; its transform says where they lie in the world
    VoxelizeReport report; ///< how they were made
};

/// Turns a model into a solid: the voxels that a face touches, and those inside. The \ref voxelize "page of this room"
/// says where voxels are, which are touched, which are inside, and when a model is too small.
/// \param model any polygon soup: closed or open, of several parts, self-intersecting
/// \param options all in range; `box` holds the model
/// \param interrupter told of progress; may be null
/// \throw InputError when the resolution is out of range, the box does not hold the model, the model is too small or
/// too large, or requireUsable() refuses it
/// \throw DeviceError when there is no OpenGL 4.5 or it fails, or cgal is not in this build; never with automatic and
/// cpu
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(faces + touched voxels + box / 64) for a box of that many voxels, at most (resolution + 1)^3; box / 7 bytes.
/// Based on: Akenine-Moller 2001; Schwarz and Seidel 2010; Nooruddin and Turk 2003 (votes of parity counts).
VDBCAGE_API Voxelization voxelize(const Mesh& model, const VoxelizeOptions& options = {},
                                  Interrupter* interrupter = nullptr);

} // namespace vdbcage
