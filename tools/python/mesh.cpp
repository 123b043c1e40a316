#include <utility>

#include <pybind11/stl.h>
#include <vdbcage/mesh/mesh_io.h>

#include "arrays.h"
#include "job.h"
#include "module.h"

namespace py = pybind11;

namespace vdbcage::python {

void defineMesh(py::module_& module)
{
    py::class_<Mesh, MeshPtr>(module, "Mesh", py::module_local())
        .def(py::init([](const py::array& points, const py::array& triangles, const py::array& quads) {
            return std::make_shared<Mesh>(
                Mesh{toRows<openvdb::Vec3d>(points), toRows<openvdb::Vec3I>(triangles), toRows<openvdb::Vec4I>(quads)});
        }))
        .def_property_readonly("points",
                               [](const py::object& self) { return readOnly(self.cast<const Mesh&>().points, self); })
        .def_property_readonly(
            "triangles", [](const py::object& self) { return readOnly(self.cast<const Mesh&>().triangles, self); })
        .def_property_readonly("quads",
                               [](const py::object& self) { return readOnly(self.cast<const Mesh&>().quads, self); });

    module.def("loose_points", [](const Mesh& mesh) {
        const std::vector<openvdb::Index32> loose = loosePoints(mesh);
        return py::array_t<openvdb::Index32>(static_cast<py::ssize_t>(loose.size()), loose.data());
    });
    module.def("read_mesh", [](const std::string& path) {
        MeshFile file = resultOfJob(py::none(), [&](Interrupter*) { return readMeshFile(path); });
        return py::make_tuple(std::make_shared<Mesh>(std::move(file.mesh)), std::move(file.summary.warnings));
    });
    module.def("is_held", [](const Mesh& mesh, const std::string& path) {
        return resultOfJob(py::none(), [&](Interrupter*) { return asWritten(mesh, path).points == mesh.points; });
    });
    module.def("write_mesh", [](const Mesh& mesh, const std::string& path) {
        runJob(py::none(), [&](Interrupter*) { writeMesh(mesh, std::filesystem::path(path)); });
    });
}

} // namespace vdbcage::python
