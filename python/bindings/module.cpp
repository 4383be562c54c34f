#include "python/bindings/bindings.hpp"

#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "reference_rt/truth.hpp"
#include "reports/catalogue/catalogue.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/error.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

namespace py = pybind11;

namespace {

std::vector<std::string> builtin_names()
{
    std::vector<std::string> names;
    for (const auto& scene : gnomon::scene::builtin_scenes()) {
        names.push_back(scene.name);
    }
    return names;
}

std::vector<std::string> key_names()
{
    std::vector<std::string> names;
    for (const auto& key : gnomon::methods::key_table()->rows()) {
        names.push_back(key.name);
    }
    return names;
}

} // namespace

PYBIND11_MODULE(_gnomon, module)
{
    namespace python = gnomon::python;
    py::register_exception<gnomon::scene::InputError>(module, "InputError", PyExc_ValueError);
    py::register_exception<gnomon::scene::EnvironmentError>(module, "EnvironmentError",
                                                            PyExc_RuntimeError);
    module.attr("version") = GNOMON_VERSION;
    module.def("embree_version", &gnomon::reference_rt::embree_version);
    module.def("builtin_names", &builtin_names);
    module.def("key_names", &key_names);
    module.def("methods_json",
               [] { return gnomon::reports::methods_json(gnomon::methods::methods()); });
    python::bind_depth(module);
    python::bind_jobs(module);
    python::bind_scene(module);
    python::bind_truth(module);
    python::bind_comparison(module);
    python::bind_sun(module);
    python::bind_sweep(module);
    python::bind_tune(module);
}
