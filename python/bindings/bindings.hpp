#pragma once

#include <pybind11/pybind11.h>

/// The parts of the module `gnomon._gnomon`, which the package `gnomon` wraps.
namespace gnomon::python {

/// Raises KeyboardInterrupt after Ctrl-C. Takes the GIL itself.
/// @throws pybind11::error_already_set  if Ctrl-C was pressed.
inline void check_signals()
{
    const pybind11::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) {
        throw pybind11::error_already_set();
    }
}

void bind_comparison(pybind11::module_& module);
void bind_depth(pybind11::module_& module);
void bind_jobs(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_sun(pybind11::module_& module);
void bind_sweep(pybind11::module_& module);
void bind_truth(pybind11::module_& module);
void bind_tune(pybind11::module_& module);

} // namespace gnomon::python
