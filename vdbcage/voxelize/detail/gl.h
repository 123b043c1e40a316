#pragma once

#include <cstddef>

#include <vdbcage/gl/objects.h>
#include <vdbcage/gl/program.h>
#include <vdbcage/voxelize/detail/backend.h>

namespace vdbcage::detail {

/// A voxelizer with the shaders of one OpenGL context. The context must be current whenever a function of this is
/// called, and when it is destroyed. The bits are those of voxelizeCpu.
class GlVoxelizer {
public:
    /// The way from triangles to columns of voxels.
    enum class Path {
        compute, ///< a loop over the columns of each triangle
        raster   ///< a fragment for each column of each triangle
    };
    /// The memory of the device for the voxels processed at a time. More voxels are processed slab by slab.
    static constexpr std::size_t usualGridBytes = std::size_t(128) << 20;

    /// Compiles the shaders. `api` must outlive this.
    /// \throw DeviceError
    GlVoxelizer(const gl::Api& api, Path path, std::size_t gridBytes = usualGridBytes);

    /// Voxelizes as a Backend. It uses TBB: a thread that waits must not take work of others that need a context (see
    /// voxelizeGl).
    BitGrid run(const Mesh& model, const Frame& frame, Interrupter* interrupter) const;

private:
    const gl::Api& api_;
    Path path_;
    std::size_t gridBytes_;
    gl::ProgramObject program_;
};

} // namespace vdbcage::detail
