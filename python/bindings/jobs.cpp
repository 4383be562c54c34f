#include "python/bindings/jobs.hpp"

#include "methods/key_table.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <unistd.h>

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
            throw scene::InputError(
                "max_bytes limits the maps of searched methods: give methods as well");
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

namespace {

/// The process's GL context, current on one thread at a time. It is kept, as EGL destroys all
/// contexts of a display together and each new context leaks some memory.
struct SharedContext {
    std::mutex turn;
    std::optional<int> device;
    pid_t process = 0; ///< the process that made the context
    std::shared_ptr<const raster_gl::Context> context;
};

/// Never destroyed, as the driver shuts down before static objects.
SharedContext& shared()
{
    static auto* const kept = new SharedContext;
    return *kept;
}

} // namespace

GlTurn::GlTurn(std::optional<int> device) : alone_{shared().turn}
{
    SharedContext& kept = shared();
    if (kept.context != nullptr && kept.process != getpid()) {
        throw scene::EnvironmentError("this process was forked after GL was used, and drivers do "
                                      "not support that: start it with \"spawn\"");
    }
    if (kept.context != nullptr && kept.device == device) {
        kept.context->make_current();
    } else {
        kept.context.reset();
        kept.context = std::make_shared<const raster_gl::Context>(device);
        kept.device = device;
        kept.process = getpid();
    }
}

api::SessionOptions GlTurn::options(int threads) const
{
    return {.device = shared().device, .threads = threads, .context = shared().context};
}

std::unique_ptr<const api::ComparisonSession> GlTurn::open(const JobPlace& place,
                                                           const ReadJob& job, int threads) const
{
    api::SessionOptions own = options(threads);
    own.check_interruption = check_signals;
    return place.scene != nullptr ? std::make_unique<const api::ComparisonSession>(
                                        place.scene->file(), job.lights, own)
                                  : std::make_unique<const api::ComparisonSession>(job.lights, own);
}

} // namespace gnomon::python
