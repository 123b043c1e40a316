#include <vdbcage/voxelize/voxelize.h>

#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/backend.h>

namespace vdbcage {

namespace {

detail::Backend& chooseBackend(Voxelizer voxelizer)
{
    switch (voxelizer) {
    case Voxelizer::automatic:
    case Voxelizer::cpu:
        break;
    case Voxelizer::gl:
        return detail::voxelizeGl;
    case Voxelizer::cgal:
        return detail::voxelizeCgal;
    }
    return detail::voxelizeCpu;
}

} // namespace

openvdb::MaskGrid::Ptr voxelize(const Mesh& model, const VoxelizeOptions& options, Interrupter* interrupter)
{
    constexpr int highest = 4096;
    if (options.resolution < 1 || options.resolution > highest) {
        throw InputError("resolution is " + std::to_string(options.resolution) + "; 1 to " + std::to_string(highest) +
                         " is allowed");
    }
    detail::Backend& backend = chooseBackend(options.voxelizer);
    requireUsable(model, "model");
    const detail::Frame frame = detail::makeFrame(model, options.resolution);
    return detail::toMask(backend(model, frame, interrupter), detail::makeTransform(frame), interrupter);
}

} // namespace vdbcage
