#pragma once

#include <pybind11/pybind11.h>

/// The module `gnomon._gnomon`, part by part. The package `gnomon` in front of it is what people
/// call.
namespace gnomon::python {

void bind_scene(pybind11::module_& module);
void bind_truth(pybind11::module_& module);
void bind_comparison(pybind11::module_& module);

} // namespace gnomon::python
