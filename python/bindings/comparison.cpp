#include "analysis/comparison/comparison.hpp"

#include "api/advice.hpp"
#include "api/compare.hpp"
#include "api/mask.hpp"
#include "methods/key_table.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/jobs.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/pictures/picture.hpp"
#include "reports/settings/settings_text.hpp"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace gnomon::python {
namespace {

using analysis::Comparison;

/// A comparison with the objects that it refers to.
struct OwnedComparison {
    std::shared_ptr<const scene::SceneFile> file;
    std::shared_ptr<const api::CaseMesh> mesh;
    Comparison comparison;
};
using Shared = std::shared_ptr<OwnedComparison>;

/// Adds advice to the comparisons.
void advise(std::vector<Comparison>& comparisons, const api::ComparisonSession& session,
            const ReadJob& job, const AdviceRequest& request)
{
    const auto methods = methods_of(request);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        api::advise(comparisons[i], session,
                    api::view_request(request.views, job.source, job.lights[i].light), methods);
    }
}

std::vector<Shared> compare(const JobPlace& place, const TextPairs& keys, const JobChoice& choice,
                            const std::optional<AdviceRequest>& advice, std::optional<int> device,
                            int threads)
{
    const py::gil_scoped_release released;
    const ReadJob job = read_job(place, keys, choice);
    if (advice && advice->methods.empty()) {
        api::require_advisable(job.lights);
    }
    const GlTurn turn{device};
    const auto session = turn.open(place, job, threads);
    auto compared = api::compare(*session, job.lights);
    if (advice) {
        advise(compared, *session, job, *advice);
    }
    std::vector<Shared> owned;
    for (Comparison& comparison : compared) {
        owned.push_back(std::make_shared<OwnedComparison>(
            OwnedComparison{session->shared_file(), nullptr, std::move(comparison)}));
    }
    return owned;
}

Shared evaluate(const api::Scene& scene, const py::object& mask, const py::object& positions,
                const py::object& normals, const std::optional<std::array<double, 3>>& eye,
                bool has_fractions, const TextPairs& keys, std::optional<double> tolerance_m,
                int threads)
{
    api::Mask given;
    given.values = image_of<float>(mask, "mask");
    given.positions = image_of<scene::Vec3f, 3>(positions, "positions");
    given.normals = image_of<scene::Vec3f, 3>(normals, "normals");
    if (eye) {
        given.eye = scene::Vec3d{(*eye)[0], (*eye)[1], (*eye)[2]};
    }
    given.has_fractions = has_fractions;
    given.keys = overrides_of(keys);
    given.tolerance_m = tolerance_m;
    const py::gil_scoped_release released;
    api::EvaluatedMask evaluated = api::evaluate(scene, std::move(given), threads);
    return std::make_shared<OwnedComparison>(
        OwnedComparison{nullptr, std::move(evaluated.mesh), std::move(evaluated.comparison)});
}

/// The comparison's shadow map in an engine's settings, as JSON with one element.
std::string settings(const OwnedComparison& self, const std::string& engine, bool recommended)
{
    const reports::SettingsTarget target =
        reports::find_settings_target(*methods::key_table(), engine, "engine " + engine);
    return reports::settings_json(
        std::array{reports::translate(target, self.comparison, recommended)});
}

/// Enum codes as bytes.
template <typename Code>
py::object codes(const scene::Image<Code>& image, py::handle owner)
{
    static_assert(sizeof(Code) == 1);
    return view_of(image, reinterpret_cast<const std::uint8_t*>(image.data()), owner);
}

/// Triangle indices, with −1 for none.
py::object indices(const scene::Image<std::uint32_t>& image, py::handle owner)
{
    return view_of(image, reinterpret_cast<const std::int32_t*>(image.data()), owner);
}

/// One member of all lookup samples.
py::object numbers(const scene::Image<scene::LookupSample>& samples, const float* first,
                   py::handle owner)
{
    return view_of(samples, first, owner);
}

/// Every layer over the comparison's memory, by its name in an EXR file.
py::dict layers(const py::object& self)
{
    const Comparison& comparison = self.cast<const OwnedComparison&>().comparison;
    py::dict all;
    all["class"] = codes(comparison.truth.pixel_class, self);
    all["reason"] = codes(comparison.truth.reason, self);
    all["witness"] = indices(comparison.truth.witness, self);
    all["prim"] = indices(comparison.receivers.triangle, self);
    const auto& samples = comparison.lookup.samples;
    if (!samples.empty()) {
        all["verdict"] = numbers(samples, &samples.data()->verdict, self);
        all["receiver_depth"] = numbers(samples, &samples.data()->receiver_depth, self);
        all["map_depth"] = numbers(samples, &samples.data()->map_depth, self);
        all["tan_theta"] = numbers(samples, &samples.data()->tan_theta, self);
    }
    if (const auto& texels = comparison.lookup.texels; !texels.empty()) {
        all["texel"] = view_of(texels, &texels.data()->x, self, 2);
    }
    if (const auto& maps = comparison.lookup.maps; !maps.empty()) {
        all["map_index"] = view_of(maps, maps.data(), self);
    }
    if (const auto& diagnosis = comparison.diagnosis) {
        all["light_distance_m"] =
            view_of(diagnosis->light_distance_m, diagnosis->light_distance_m.data(), self);
        all["map_error_m"] = view_of(diagnosis->map_error_m, diagnosis->map_error_m.data(), self);
        all["cause"] = codes(diagnosis->causes.cause, self);
        all["label"] = codes(diagnosis->causes.label, self);
        if (diagnosis->biases) {
            const auto& critical = diagnosis->biases->critical_bias;
            all["critical_bias"] = view_of(critical, critical.data(), self);
        }
    }
    return all;
}

/// The critical biases of scored lit and blocked pixels, ascending; None without a curve.
py::object curve(const py::object& self)
{
    const Comparison& comparison = self.cast<const OwnedComparison&>().comparison;
    if (!comparison.diagnosis || !comparison.diagnosis->biases) {
        return py::none();
    }
    const analysis::BiasCurve& of_bias = comparison.diagnosis->biases->curve;
    return py::make_tuple(view_of(of_bias.lit(), self), view_of(of_bias.blocked(), self));
}

/// height × width: the midpoint of a scored pixel's visible share of the light, else −1.
py::array truth(const OwnedComparison& self)
{
    const scene::Truth& found = self.comparison.truth;
    const scene::ImageSize size = found.pixel_class.size();
    py::array_t<float> shares{{size.height_px, size.width_px}};
    float* const numbers = shares.mutable_data();
    for (std::size_t i = 0; i < found.pixel_class.pixel_count(); ++i) {
        numbers[i] = scene::is_scored(found.pixel_class[i]) ? found.share(i).middle() : -1.0F;
    }
    return shares;
}

/// height × width × 3: P.
py::array positions(const OwnedComparison& self)
{
    const auto points = api::points_of(self.comparison);
    py::array_t<float> numbers{{points.size().height_px, points.size().width_px, 3}};
    std::memcpy(numbers.mutable_data(), points.data(), points.pixel_count() * sizeof(scene::Vec3f));
    return numbers;
}

py::array picture(const OwnedComparison& self)
{
    store::RgbImage drawn;
    {
        const py::gil_scoped_release released;
        drawn = reports::draw_picture(self.comparison);
    }
    static_assert(sizeof(store::Rgb) == 3);
    py::array_t<std::uint8_t> pixels{{drawn.size().height_px, drawn.size().width_px, 3}};
    std::memcpy(pixels.mutable_data(), drawn.data(), drawn.pixel_count() * sizeof(store::Rgb));
    return pixels;
}

py::bytes picture_png(const OwnedComparison& self)
{
    std::vector<std::byte> png;
    {
        const py::gil_scoped_release released;
        png = store::encode_png(reports::draw_picture(self.comparison));
    }
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

} // namespace

void bind_comparison(py::module_& module)
{
    py::class_<OwnedComparison, Shared>(module, "Comparison")
        .def_property_readonly("light",
                               [](const OwnedComparison& self) { return self.comparison.light; })
        .def("layers", &layers)
        .def("curve", &curve)
        .def("truth", &truth)
        .def("positions", &positions)
        .def("json",
             [](const OwnedComparison& self) { return reports::comparison_json(self.comparison); })
        .def("settings", &settings)
        .def("picture", &picture)
        .def("picture_png", &picture_png);
    module.def("compare", &compare);
    module.def("evaluate", &evaluate);
}

} // namespace gnomon::python
