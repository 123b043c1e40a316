#include <vdbcage/voxelize/voxelize.h>

#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/detail/backend.h>
#include <vdbcage/voxelize/detail/interior_by.h>

namespace vdbcage {

namespace detail {

std::pair<BitGrid, VoxelizeReport> voxelizeAutomatically(const Mesh& model, const Frame& frame, Backend& device,
                                                         Interrupter* interrupter)
{
    VoxelizeReport report;
    if (frame.resolution >= leastResolutionForDevice) {
        try {
            return {device(model, frame, interrupter), VoxelizeReport{Voxelizer::gl}};
        } catch (const DeviceError& error) {
            report.fallback = error.what();
        }
    }
    return {voxelizeCpu(model, frame, interrupter), report};
}

} // namespace detail

namespace {

/// Returns the model with every face twice: rays cross both, so that none counts anything as inside.
Mesh withEveryFaceTwice(const Mesh& model)
{
    Mesh doubled = model;
    doubled.triangles.insert(doubled.triangles.end(), model.triangles.begin(), model.triangles.end());
    doubled.quads.insert(doubled.quads.end(), model.quads.begin(), model.quads.end());
    return doubled;
}

std::pair<detail::BitGrid, VoxelizeReport> voxelizeBy(Voxelizer voxelizer, const Mesh& model,
                                                      const detail::Frame& frame, Interrupter* interrupter)
{
    switch (voxelizer) {
    case Voxelizer::gl:
        return {detail::voxelizeGl(model, frame, interrupter), VoxelizeReport{Voxelizer::gl}};
    case Voxelizer::cgal:
        return {detail::voxelizeCgal(model, frame, interrupter), VoxelizeReport{Voxelizer::cgal}};
    case Voxelizer::cpu:
        return {detail::voxelizeCpu(model, frame, interrupter), VoxelizeReport{Voxelizer::cpu}};
    case Voxelizer::automatic:
        break;
    }
    return detail::voxelizeAutomatically(model, frame, detail::voxelizeGlHardware, interrupter);
}

} // namespace

Voxelization voxelize(const Mesh& model, const VoxelizeOptions& options, Interrupter* interrupter)
{
    requireWithin(VoxelizeOptions::resolutions, options.resolution, "resolution");
    requireUsable(model, "model");
    const detail::Frame frame = detail::makeFrame(model, options.resolution, options.box);
    std::optional<double> agreement;
    Interior interior = options.interior;
    if (interior == Interior::automatic) {
        agreement = rayAgreement(model, interrupter);
        interior = detail::interiorBy(*agreement);
    }
    const Mesh doubled = interior == Interior::shell ? withEveryFaceTwice(model) : Mesh();
    const Mesh& counted = interior == Interior::shell ? doubled : model;
    auto [bits, report] = voxelizeBy(options.voxelizer, counted, frame, interrupter);
    report.interior = interior;
    report.agreement = agreement;
    return {detail::toMask(std::move(bits), detail::makeTransform(frame), interrupter), std::move(report)};
}

} // namespace vdbcage
