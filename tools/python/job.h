#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::python {

/// Defines what runJob needs: the calls that are running, which end with Cancelled when Python does. A thread that came
/// back to a Python that has ended would abort the process.
void defineJobs(pybind11::module_& module);

/// Runs `work` in a thread of its own, without Python's lock, and returns when that thread has ended.
///
/// The caller's thread wakes 20 times a second. It runs the handlers of signals that came, and calls
/// `progress(stage, percent)` unless that is None. What either throws cancels the work and comes out unchanged.
/// \pre the caller holds Python's lock; `work` touches no Python object
/// \throw Cancelled `progress` returned False, or Python is ending
/// \throw what `work` throws
void runJob(const pybind11::object& progress, const std::function<void(Interrupter*)>& work);

/// The same of work that has a result.
template <typename Work>
auto resultOfJob(const pybind11::object& progress, const Work& work)
{
    std::optional<decltype(work(nullptr))> result;
    runJob(progress, [&](Interrupter* interrupter) { result.emplace(work(interrupter)); });
    return std::move(*result);
}

} // namespace vdbcage::python
