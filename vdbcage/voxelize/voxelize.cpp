#include <vdbcage/voxelize/voxelize.h>

#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/backend.h>

namespace vdbcage {

namespace detail {

std::pair<BitGrid, VoxelizeReport> voxelizeAutomatically(const Mesh& model, const Frame& frame, Backend& device,
                                                         Interrupter* interrupter)
{
    VoxelizeReport report;
    if (frame.resolution >= leastResolutionForDevice) {
        try {
            return {device(model, frame, interrupter), VoxelizeReport{Voxelizer::gl, {}}};
        } catch (const DeviceError& error) {
            report.fallback = error.what();
        }
    }
    return {voxelizeCpu(model, frame, interrupter), report};
}

} // namespace detail

Voxelization voxelize(const Mesh& model, const VoxelizeOptions& options, Interrupter* interrupter)
{
    requireWithin(VoxelizeOptions::resolutions, options.resolution, "resolution");
    requireUsable(model, "model");
    const detail::Frame frame = detail::makeFrame(model, options.resolution, options.box);
    const auto run = [&]() -> std::pair<detail::BitGrid, VoxelizeReport> {
        switch (options.voxelizer) {
        case Voxelizer::gl:
            return {detail::voxelizeGl(model, frame, interrupter), VoxelizeReport{Voxelizer::gl, {}}};
        case Voxelizer::cgal:
            return {detail::voxelizeCgal(model, frame, interrupter), VoxelizeReport{Voxelizer::cgal, {}}};
        case Voxelizer::cpu:
            return {detail::voxelizeCpu(model, frame, interrupter), VoxelizeReport{Voxelizer::cpu, {}}};
        case Voxelizer::automatic:
            break;
        }
        return detail::voxelizeAutomatically(model, frame, detail::voxelizeGlHardware, interrupter);
    };
    auto [bits, report] = run();
    return {detail::toMask(std::move(bits), detail::makeTransform(frame), interrupter), std::move(report)};
}

} // namespace vdbcage
