#include <utility>

#include <pybind11/stl.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/posed_points.h>
#include <vdbcage/deform/weights_io.h>

#include "arrays.h"
#include "job.h"
#include "module.h"

namespace py = pybind11;

namespace vdbcage::python {

namespace {

using Points = std::vector<openvdb::Vec3d>;

/// An array of the weights, a row a point, that owns them.
py::array toMatrix(std::vector<float> weights, std::size_t columns)
{
    auto held = std::make_unique<std::vector<float>>(std::move(weights));
    const std::vector<float>& kept = *held;
    return py::array_t<float>({static_cast<py::ssize_t>(kept.size() / columns), static_cast<py::ssize_t>(columns)},
                              kept.data(), ownerOf(std::move(held)));
}

/// Of nu, rotations, local and global bulging.
Elasticity toElasticity(const py::tuple& values)
{
    Elasticity elasticity;
    elasticity.nu = values[0].cast<double>();
    elasticity.rotations = rotationsNamed(values[1].cast<std::string>());
    elasticity.localBulging = values[2].cast<double>();
    elasticity.globalBulging = values[3].cast<double>();
    requireElasticity(elasticity);
    return elasticity;
}

py::tuple fromElasticity(const Elasticity& elasticity)
{
    return py::make_tuple(elasticity.nu, rotationsName(elasticity.rotations), elasticity.localBulging,
                          elasticity.globalBulging);
}

} // namespace

void defineBinding(py::module_& module)
{
    module.def("coordinate_families", [] {
        py::list families;
        for (const FamilyInfo& family : coordinateFamilies()) {
            families.append(py::make_tuple(family.name, family.title, family.what, family.paper, family.isEverywhere,
                                           family.hasResolution, family.hasElasticity));
        }
        return families;
    });

    py::class_<Binding, std::shared_ptr<Binding>>(module, "Binding", py::module_local())
        .def(py::init([](const MeshPtr& cage, const py::array& points, const std::string& family, int resolution,
                         const py::tuple& elasticity, std::vector<openvdb::Index32> loose, const std::string& motion,
                         const py::object& progress) {
            CoordinateOptions coordinates(coordinatesNamed(family), resolution);
            coordinates.loose = {std::move(loose), looseMotionNamed(motion)};
            coordinates.elasticity = toElasticity(elasticity);
            Points rows = toRows<openvdb::Vec3d>(points);
            return resultOfJob(progress, [&](Interrupter* interrupter) {
                return std::make_shared<Binding>(*cage, std::move(rows), coordinates, interrupter);
            });
        }))
        .def_property_readonly("coordinates", [](const Binding& binding) { return coordinatesName(binding.family()); })
        .def_property_readonly("handles", &Binding::handles)
        .def_property_readonly("elasticity",
                               [](const Binding& binding) { return fromElasticity(binding.options().elasticity); })
        .def("with_elasticity",
             [](const Binding& binding, const py::tuple& elasticity) {
                 return std::make_shared<Binding>(binding.with(toElasticity(elasticity)));
             })
        .def_property_readonly(
            "points", [](const py::object& self) { return readOnly(self.cast<const Binding&>().points(), self); })
        .def("pose",
             [](const Binding& binding, const py::array& cagePoints) {
                 const Points cage = toRows<openvdb::Vec3d>(cagePoints);
                 return toArray(resultOfJob(py::none(), [&](Interrupter*) { return binding.pose(cage); }));
             })
        .def("update",
             [](const Binding& binding, const py::array& posed, const py::array& before, const py::array& after) {
                 Points points = toRows<openvdb::Vec3d>(posed);
                 const Points from = toRows<openvdb::Vec3d>(before), to = toRows<openvdb::Vec3d>(after);
                 runJob(py::none(), [&](Interrupter*) { binding.update(points, from, to); });
                 return toArray(std::move(points));
             })
        .def("weights",
             [](const Binding& binding, const py::object& progress) {
                 return toMatrix(resultOfJob(progress,
                                             [&](Interrupter* interrupter) {
                                                 return computeWeights(binding.cage(), binding.points(),
                                                                       binding.options(), interrupter);
                                             }),
                                 binding.handles());
             })
        .def("write", [](const Binding& binding, const std::string& path, const py::object& progress) {
            runJob(progress, [&](Interrupter* interrupter) {
                const std::vector<float> weights =
                    computeWeights(binding.cage(), binding.points(), binding.options(), interrupter);
                writeWeights(binding.cage(), binding.points(), binding.family(), weights, std::filesystem::path(path));
            });
        });

    module.def("posed_points", [](const MeshPtr& cage, const MeshPtr& posed) {
        return toArray(resultOfJob(py::none(), [&](Interrupter*) { return posedPoints(*cage, *posed).points; }));
    });

    module.def("read_binding", [](const std::string& path, const MeshPtr& cage, const py::array& points) {
        Points rows = toRows<openvdb::Vec3d>(points);
        return resultOfJob(py::none(), [&](Interrupter*) {
            return std::make_shared<Binding>(readWeights(path, *cage, std::move(rows)));
        });
    });
}

} // namespace vdbcage::python
