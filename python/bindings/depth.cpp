#include "api/depth_study.hpp"

#include "python/bindings/bindings.hpp"
#include "python/bindings/jobs.hpp"
#include "reports/depth/depth_report.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::python {
namespace {

namespace py = pybind11;

/// The index of a word in the list of allowed words.
/// @throws scene::InputError  naming the argument and the allowed words.
std::size_t index_of(std::string_view argument, const std::string& word,
                     const std::vector<std::string>& words)
{
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) {
        throw scene::InputError(
            fmt::format("{} = \"{}\": must be one of {}", argument, word, fmt::join(words, ", ")));
    }
    return static_cast<std::size_t>(found - words.begin());
}

void set_words(api::DepthRequest& request, const std::string& content,
               const std::string& projection, const std::optional<std::string>& clip)
{
    (void)index_of("content", content, api::studied_contents());
    request.content = scene::map_content_from_name(content).value();
    request.projection = index_of("projection", projection, {"perspective", "orthographic"}) == 0
                             ? scene::Projection::perspective
                             : scene::Projection::orthographic;
    if (clip) {
        request.clip_range = index_of("clip", *clip, {"zero_to_one", "minus_one_to_one"}) == 0
                                 ? scene::ClipRange::zero_to_one
                                 : scene::ClipRange::minus_one_to_one;
    }
}

/// The results of the formulas, and as JSON those measured with GL.
std::string study(const api::DepthRequest& request, const std::string& format,
                  std::optional<int> bits, bool measures, std::optional<int> device)
{
    const py::gil_scoped_release released;
    const api::DepthChoice choice = api::choose_format(format, bits);
    api::require_sound(request);
    const auto as_json = [](const api::StudiedDepth& found) {
        return reports::depth_json(found.study, found.rows, found.driver.renderer,
                                   found.driver.version);
    };
    if (!measures || !choice.format) {
        return as_json(api::study_depth(request, choice, nullptr, "not asked for"));
    }
    const GlTurn turn{device};
    return as_json(api::study_depth(request, choice, turn.options(0).context.get()));
}

} // namespace

void bind_depth(py::module_& module)
{
    py::class_<api::DepthRequest>(module, "DepthRequest")
        .def(py::init<>())
        .def_readwrite("near_m", &api::DepthRequest::near_m)
        .def_readwrite("far_m", &api::DepthRequest::far_m)
        .def_readwrite("reversed", &api::DepthRequest::reversed)
        .def_readwrite("samples", &api::DepthRequest::samples)
        .def_readwrite("tilt_deg", &api::DepthRequest::tilt_deg)
        .def_readwrite("offset_m", &api::DepthRequest::offset_m)
        .def_readwrite("tolerance_m", &api::DepthRequest::tolerance_m)
        .def("set_words", &set_words);
    module.def("depth_json", &study);
}

} // namespace gnomon::python
