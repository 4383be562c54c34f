#include "python/bindings/jobs.hpp"

#include "methods/key_table.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <algorithm>

namespace gnomon::python {

std::vector<scene::Override> overrides_of(const TextPairs& keys)
{
    std::vector<scene::Override> overrides;
    for (const auto& [key, value] : keys) {
        overrides.push_back({key, value, {}});
    }
    return overrides;
}

scene::JobSource source_of(const JobPlace& place, const TextPairs& keys)
{
    const scene::Keys& table = methods::key_table();
    const std::vector<scene::Override> over = overrides_of(keys);
    scene::JobSource source;
    if (place.scene != nullptr) {
        source.keys = table;
        source.name = "scene";
        source.file = scene::layer_from_overrides(*table, {{"scene.file", "scene", {}}});
        source.overrides = scene::layer_from_overrides(*table, over);
    } else {
        source = place.builtin.empty() ? scene::read_job_source(place.path, over, {}, table)
                                       : scene::builtin_job_source(place.builtin, over, {}, table);
    }
    const scene::Layer own = scene::layer_from_overrides(*table, overrides_of(place.keys));
    source.file.insert(source.file.end(), own.begin(), own.end());
    return source;
}

ReadJob read_job(const JobPlace& place, const TextPairs& keys, const JobChoice& choice)
{
    ReadJob read{source_of(place, keys), {}};
    read.lights = scene::light_jobs(read.source, choice.case_name);
    if (!choice.light.empty()) {
        const auto wanted = std::ranges::find(read.lights, choice.light, &scene::LightJob::light);
        if (wanted == read.lights.end()) {
            throw scene::InputError(fmt::format(
                "only_light = \"{}\": the job has no light of this name", choice.light));
        }
        read.lights = {*wanted};
    }
    return read;
}

std::optional<analysis::MethodRequest> methods_of(const AdviceRequest& request)
{
    if (request.methods.empty()) {
        if (request.max_bytes) {
            throw scene::InputError("max_bytes bounds the maps of methods that are compared: give "
                                    "methods, too");
        }
        return std::nullopt;
    }
    return api::method_request(request.methods, request.max_bytes);
}

void bind_jobs(pybind11::module_& module)
{
    namespace py = pybind11;
    py::class_<JobPlace>(module, "JobPlace")
        .def(py::init([](std::string path, std::string builtin,
                         std::shared_ptr<const api::Scene> scene, TextPairs keys) {
            return JobPlace{std::move(path), std::move(builtin), std::move(scene), std::move(keys)};
        }))
        .def_readonly("path", &JobPlace::path)
        .def_readonly("builtin", &JobPlace::builtin)
        .def_readonly("keys", &JobPlace::keys)
        .def_property_readonly("is_in_memory",
                               [](const JobPlace& self) { return self.scene != nullptr; });
    py::class_<JobChoice>(module, "JobChoice")
        .def(py::init([](std::string case_name, std::string light) {
            return JobChoice{std::move(case_name), std::move(light)};
        }));
    py::class_<AdviceRequest>(module, "AdviceRequest")
        .def(py::init([](int cameras, int lights, bool all_cases, std::vector<std::string> methods,
                         std::optional<std::uint64_t> max_bytes) {
            return AdviceRequest{{cameras, lights, all_cases}, std::move(methods), max_bytes};
        }));
}

} // namespace gnomon::python
