#pragma once

#include <memory>

#include <openvdb/openvdb.h>
#include <pybind11/pybind11.h>
#include <vdbcage/mesh/mesh.h>

/// vdbcage._vdbcage, what the package vdbcage (vdbcage/__init__.py) is built on. It takes what that has checked: arrays
/// of the right shape, paths as bytes.
namespace vdbcage::python {

/// Meshes are never changed once Python has them, so that arrays can look into them and threads can share them.
using MeshPtr = std::shared_ptr<Mesh>;

/// A mask is never changed either.
struct VolumeMask {
    openvdb::MaskGrid::ConstPtr grid;
};

void defineMesh(pybind11::module_& module);
void defineCage(pybind11::module_& module);
void defineBinding(pybind11::module_& module);
void defineVolume(pybind11::module_& module);

} // namespace vdbcage::python
