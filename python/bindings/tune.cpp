#include "api/tune.hpp"

#include "python/bindings/bindings.hpp"
#include "python/bindings/jobs.hpp"
#include "reports/tune/tune_report.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::python {
namespace {

namespace py = pybind11;

/// The result of a search, and the scene that it refers to.
struct OwnedTuning {
    std::shared_ptr<const scene::SceneFile> file;
    reports::TunedLight tuned;
};
using Shared = std::shared_ptr<OwnedTuning>;

std::vector<Shared> tune(const JobPlace& place, const TextPairs& keys, const JobChoice& choice,
                         const AdviceRequest& over, const analysis::TuneGoal& goal,
                         std::optional<int> device, int threads)
{
    const py::gil_scoped_release released;
    const ReadJob job = read_job(place, keys, choice);
    const api::TuneRequest request{goal, methods_of(over)};
    if (!request.methods) {
        api::require_tunable(job.lights);
    }
    std::vector<analysis::ViewRequest> views;
    for (const scene::LightJob& light : job.lights) {
        views.push_back(api::view_request(over.views, job.source, light.light));
    }
    const GlTurn turn{device};
    const auto session = turn.open(place, job, threads);
    std::vector<Shared> owned;
    for (reports::TunedLight& tuned : api::tune(*session, job.lights, views, request)) {
        owned.push_back(
            std::make_shared<OwnedTuning>(OwnedTuning{session->shared_file(), std::move(tuned)}));
    }
    return owned;
}

} // namespace

void bind_tune(py::module_& module)
{
    py::class_<analysis::TuneGoal>(module, "TuneGoal")
        .def(py::init<>())
        .def_readwrite("max_shadow_amount_rate", &analysis::TuneGoal::max_shadow_amount_rate)
        .def_readwrite("max_light_amount_rate", &analysis::TuneGoal::max_light_amount_rate)
        .def_readwrite("max_false_shadow_rate", &analysis::TuneGoal::max_false_shadow_rate)
        .def_readwrite("max_false_lit_rate", &analysis::TuneGoal::max_false_lit_rate)
        .def_readwrite("max_resolution", &analysis::TuneGoal::max_resolution_texels)
        .def_readwrite("time_s", &analysis::TuneGoal::time_s);
    py::class_<OwnedTuning, Shared>(module, "Tuning")
        .def_property_readonly("light", [](const OwnedTuning& self) { return self.tuned.light; })
        .def("json",
             [](const OwnedTuning& self) {
                 return reports::tune_json({&self.tuned, 1});
             })
        .def("text", [](const OwnedTuning& self) {
            return reports::tune_text({&self.tuned, 1}, reports::TuneDetail::found);
        });
    module.def("tune", &tune);
}

} // namespace gnomon::python
