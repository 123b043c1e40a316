#include "module.h"

#include "job.h"

#include <exception>

#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>

namespace py = pybind11;

namespace vdbcage::python {

namespace {

/// Raises the package's exception of this name.
void raise(const char* name, const std::exception& error)
{
    const char* text = error.what(); // of an Error: printable, so UTF-8
    const py::object type = py::module_::import("vdbcage").attr(name);
    PyErr_SetString(type.ptr(), text);
}

void translate(std::exception_ptr thrown)
{
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
        raise("InputError", error);
    } catch (const IoError& error) {
        raise("IoError", error);
    } catch (const DeviceError& error) {
        raise("DeviceError", error);
    } catch (const Cancelled& error) {
        raise("Cancelled", error);
    } catch (const Error& error) {
        raise("Error", error);
    }
}

} // namespace

} // namespace vdbcage::python

PYBIND11_MODULE(_vdbcage, module)
{
    using namespace vdbcage::python;
    py::register_exception_translator(translate);
    module.attr("version") = VDBCAGE_VERSION;
    defineJobs(module);
    defineMesh(module);
    defineCage(module);
    defineBinding(module);
    defineVolume(module);
}
