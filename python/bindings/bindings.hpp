#pragma once

#include <pybind11/pybind11.h>

/// The module `gnomon._gnomon`, part by part. The package `gnomon` in front of it is what people
/// call.
namespace gnomon::python {

/// Lets Ctrl-C end the work. Python's lock may be free.
/// @throws pybind11::error_already_set  if it was pressed.
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
