#include <vdbcage/voxelize/voxelize.h>

#include <string>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/backend.h>

namespace vdbcage {

namespace detail {

BitGrid voxelizeAutomatically(const Mesh& model, const Frame& frame, Backend& device, VoxelizeReport& report,
                              Interrupter* interrupter)
{
    report = {};
    if (frame.resolution >= leastResolutionForDevice) {
        try {
            BitGrid bits = device(model, frame, interrupter);
            report.voxelizer = Voxelizer::gl;
            return bits;
        } catch (const DeviceError& error) {
            report.fallback = error.what();
        }
    }
    return voxelizeCpu(model, frame, interrupter);
}

} // namespace detail

openvdb::MaskGrid::Ptr voxelize(const Mesh& model, const VoxelizeOptions& options, Interrupter* interrupter,
                                VoxelizeReport* report)
{
    constexpr int highest = 4096;
    if (options.resolution < 1 || options.resolution > highest) {
        throw InputError("resolution is " + std::to_string(options.resolution) + "; 1 to " + std::to_string(highest) +
                         " is allowed");
    }
    requireUsable(model, "model");
    const detail::Frame frame = detail::makeFrame(model, options.resolution, options.box);
    VoxelizeReport done;
    done.voxelizer = options.voxelizer;
    const auto run = [&] {
        switch (options.voxelizer) {
        case Voxelizer::gl:
            return detail::voxelizeGl(model, frame, interrupter);
        case Voxelizer::cgal:
            return detail::voxelizeCgal(model, frame, interrupter);
        case Voxelizer::cpu:
            return detail::voxelizeCpu(model, frame, interrupter);
        case Voxelizer::automatic:
            break;
        }
        return detail::voxelizeAutomatically(model, frame, detail::voxelizeGlHardware, done, interrupter);
    };
    openvdb::MaskGrid::Ptr mask = detail::toMask(run(), detail::makeTransform(frame), interrupter);
    if (report) *report = std::move(done);
    return mask;
}

} // namespace vdbcage
