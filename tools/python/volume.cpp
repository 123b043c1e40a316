#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/options.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/volume/vdb_io.h>
#include <vdbcage/voxelize/detail/frame.h>
#include <vdbcage/voxelize/voxelize.h>

#include "arrays.h"
#include "job.h"
#include "module.h"

namespace py = pybind11;

namespace vdbcage::python {

namespace {

constexpr openvdb::Index64 mostVoxels = openvdb::Index64{1} << 30U; // 12 GiB of an array

openvdb::MaskGrid::Ptr toGrid(const std::vector<openvdb::Vec3i>& voxels, double voxelSize, const openvdb::Vec3d& origin)
{
    const openvdb::MaskGrid::Ptr grid = openvdb::MaskGrid::create();
    openvdb::MaskGrid::Accessor accessor = grid->getAccessor();
    for (const openvdb::Vec3i& voxel : voxels) accessor.setValueOn(openvdb::Coord(voxel));
    grid->tree().prune();
    detail::Frame frame; // whose index 0 is at its centre, since it is 0 voxels wide
    frame.center = origin;
    frame.voxelSize = voxelSize;
    frame.resolution = 0;
    grid->setTransform(detail::makeTransform(frame));
    return grid;
}

/// The active voxels in the order of x, then y, then z.
std::vector<openvdb::Vec3i> activeVoxels(const openvdb::MaskGrid& grid)
{
    const openvdb::Index64 count = grid.activeVoxelCount();
    if (count > mostVoxels) {
        throw InputError("mask", "it has " + std::to_string(count) + " active voxels; an array can have " +
                                     std::to_string(mostVoxels));
    }
    std::vector<openvdb::Vec3i> voxels;
    voxels.reserve(count);
    for (auto active = grid.cbeginValueOn(); active; ++active) {
        openvdb::CoordBBox box;
        active.getBoundingBox(box);
        for (auto voxel = box.begin(); voxel; ++voxel) voxels.push_back((*voxel).asVec3i());
    }
    std::sort(voxels.begin(), voxels.end());
    return voxels;
}

/// From index space to world space, a matrix for columns.
std::vector<openvdb::Vec4d> matrixOf(const openvdb::math::Transform& transform)
{
    if (!transform.isLinear()) throw InputError("mask", "its transform is a frustum, which is no matrix");
    const openvdb::Vec3d origin = transform.indexToWorld(openvdb::Vec3d(0));
    std::vector<openvdb::Vec4d> rows(4, openvdb::Vec4d(0));
    for (int column = 0; column < 3; ++column) {
        openvdb::Vec3d unit(0);
        unit[column] = 1;
        const openvdb::Vec3d step = transform.baseMap()->applyJacobian(unit); // exact, other than a difference
        for (int row = 0; row < 3; ++row) rows[static_cast<std::size_t>(row)][column] = step[row];
    }
    for (int row = 0; row < 3; ++row) rows[static_cast<std::size_t>(row)][3] = origin[row];
    rows[3][3] = 1;
    return rows;
}

/// Options of the command, for their values' names.
CageOptions optionsWith(const std::string& name, const std::string& value)
{
    CageOptions options;
    setOption(options, name, value);
    return options;
}

} // namespace

void defineVolume(py::module_& module)
{
    py::class_<VolumeMask>(module, "Mask", py::module_local())
        .def(py::init([](const py::array& voxels, double voxelSize, const std::array<double, 3>& origin) {
            const std::vector<openvdb::Vec3i> rows = toRows<openvdb::Vec3i>(voxels);
            return resultOfJob(py::none(), [&](Interrupter*) {
                return VolumeMask{toGrid(rows, voxelSize, openvdb::Vec3d(origin[0], origin[1], origin[2]))};
            });
        }))
        .def_property_readonly("count", [](const VolumeMask& mask) { return mask.grid->activeVoxelCount(); })
        .def("voxels",
             [](const VolumeMask& mask) {
                 return toArray(resultOfJob(py::none(), [&](Interrupter*) { return activeVoxels(*mask.grid); }));
             })
        .def("box",
             [](const VolumeMask& mask) {
                 const openvdb::CoordBBox box = mask.grid->evalActiveVoxelBoundingBox();
                 return toArray(std::vector<openvdb::Vec3i>{box.min().asVec3i(), box.max().asVec3i()});
             })
        .def("matrix", [](const VolumeMask& mask) { return toArray(matrixOf(mask.grid->transform())); });

    module.def("voxelize",
               [](const MeshPtr& model, int resolution, const std::string& voxelizer, const std::string& interior,
                  const std::optional<std::array<double, 6>>& box, const py::object& progress) {
                   VoxelizeOptions options;
                   options.resolution = resolution;
                   options.voxelizer = optionsWith("voxelizer", voxelizer).voxelizer;
                   options.interior = optionsWith("interior", interior).interior;
                   if (box) {
                       const std::array<double, 6>& b = *box;
                       options.box = openvdb::BBoxd(openvdb::Vec3d(b[0], b[1], b[2]), openvdb::Vec3d(b[3], b[4], b[5]));
                   }
                   return VolumeMask{resultOfJob(progress, [&](Interrupter* interrupter) {
                       return voxelize(*model, options, interrupter).mask;
                   })};
               });
    module.def("close_mask", [](const VolumeMask& mask, double closeRadius, double erodeRadius,
                                const std::string& element, const std::string& scale, const py::object& progress) {
        CloseOptions options;
        options.closeRadiusVoxels = closeRadius;
        options.erodeRadiusVoxels = erodeRadius;
        options.element = optionsWith("element", element).element;
        const FactorField field = optionsWith("scale-field", scale).scale;
        return VolumeMask{resultOfJob(progress, [&](Interrupter* interrupter) {
            return field.isNone() ? closeMask(*mask.grid, options, interrupter)
                                  : closeMask(*mask.grid, options, field, interrupter);
        })};
    });
    module.def("read_vdb", [](const std::string& path) {
        return VolumeMask{resultOfJob(py::none(), [&](Interrupter*) { return readVdb(path); })};
    });
    module.def("write_vdb", [](const VolumeMask& mask, const std::string& path,
                               const std::map<std::string, std::string>& metadata) {
        runJob(py::none(), [&](Interrupter*) { writeVdb(*mask.grid, std::filesystem::path(path), metadata); });
    });
}

} // namespace vdbcage::python
