// Replaces cgal.cpp in builds without CGAL's GPL packages.
#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/backend.h>

namespace vdbcage::detail {

BitGrid voxelizeCgal(const Mesh& /*model*/, const Frame& /*frame*/, Interrupter* /*interrupter*/)
{
    throw DeviceError("voxelizer cgal: this build was made without VDBCAGE_WITH_CGAL_GPL and has none");
}

} // namespace vdbcage::detail
