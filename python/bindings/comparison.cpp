#include "analysis/comparison/comparison.hpp"

#include "api/compare.hpp"
#include "api/mask.hpp"
#include "api/sweep/sweep.hpp"
#include "methods/key_table.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "raster_gl/context.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/pictures/picture.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <unistd.h>
#include <utility>

namespace gnomon::python {
namespace {

using analysis::Comparison;

/// A comparison, and what it refers to.
struct OwnedComparison {
    std::shared_ptr<const scene::SceneFile> file;
    std::shared_ptr<const api::CaseMesh> mesh;
    Comparison comparison;
};
using Shared = std::shared_ptr<OwnedComparison>;

using TextPairs = std::vector<std::pair<std::string, std::string>>;

std::vector<scene::Override> overrides_of(const TextPairs& keys)
{
    std::vector<scene::Override> overrides;
    for (const auto& [key, value] : keys) {
        overrides.push_back({key, value, {}});
    }
    return overrides;
}

/// Where a job comes from: a file, a built-in scene, or a scene in memory.
struct JobPlace {
    std::string path;
    std::string builtin;
    std::shared_ptr<const api::Scene> scene;
};

scene::JobSource source_of(const JobPlace& place, const TextPairs& keys)
{
    const scene::Keys& table = methods::key_table();
    if (place.scene != nullptr) {
        scene::JobSource source;
        source.keys = table;
        source.name = "scene";
        source.file = scene::layer_from_overrides(*table, {{"scene.file", "scene", {}}});
        source.overrides = scene::layer_from_overrides(*table, overrides_of(keys));
        return source;
    }
    return place.builtin.empty()
               ? scene::read_job_source(place.path, overrides_of(keys), {}, table)
               : scene::builtin_job_source(place.builtin, overrides_of(keys), {}, table);
}

std::vector<scene::LightJob> jobs_of(const JobPlace& place, const TextPairs& keys,
                                     const std::string& case_name, const std::string& light)
{
    auto jobs = scene::light_jobs(source_of(place, keys), case_name);
    if (!light.empty()) {
        const auto wanted = std::ranges::find(jobs, light, &scene::LightJob::light);
        if (wanted == jobs.end()) {
            throw scene::InputError(
                fmt::format("only_light = \"{}\": the job has no light of this name", light));
        }
        return {*wanted};
    }
    return jobs;
}

/// The process's GL context, which is current on one thread at a time. EGL ends all contexts of a
/// display together, and each one that is made leaves some memory behind: one is kept.
struct SharedContext {
    std::mutex turn;
    std::optional<int> device;
    pid_t process = 0; ///< that made the context
    std::shared_ptr<const raster_gl::Context> context;
};

/// A thread's turn to draw. The context that the thread had, of another library, is its again
/// afterwards.
class GlTurn {
public:
    explicit GlTurn(std::optional<int> device) : alone_{shared().turn}
    {
        SharedContext& kept = shared();
        if (kept.context != nullptr && kept.process != getpid()) {
            throw scene::EnvironmentError("this process was forked from one that had drawn, and "
                                          "drivers do not work in both: start it anew (\"spawn\")");
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
    GlTurn(const GlTurn&) = delete;
    GlTurn& operator=(const GlTurn&) = delete;

    [[nodiscard]] const std::shared_ptr<const raster_gl::Context>& context() const
    {
        return shared().context;
    }

private:
    /// Never destroyed: the driver ends before static objects do.
    static SharedContext& shared()
    {
        static auto* const kept = new SharedContext;
        return *kept;
    }

    std::lock_guard<std::mutex> alone_;
    raster_gl::PreviousContext previous_;
};

std::vector<Shared> compare(const std::string& path, const std::string& builtin,
                            std::shared_ptr<const api::Scene> scene, const TextPairs& keys,
                            const std::string& case_name, const std::string& light,
                            std::optional<int> device, int threads)
{
    const py::gil_scoped_release released;
    const JobPlace place{path, builtin, std::move(scene)};
    const auto jobs = jobs_of(place, keys, case_name, light);
    const GlTurn turn{device};
    const api::SessionOptions options{
        .device = device, .threads = threads, .context = turn.context()};
    const auto session =
        place.scene != nullptr
            ? std::make_unique<const api::ComparisonSession>(place.scene->file(), jobs, options)
            : std::make_unique<const api::ComparisonSession>(jobs, options);
    auto compared = api::compare(*session, jobs, {.check_interruption = check_signals});
    std::vector<Shared> owned;
    for (Comparison& comparison : compared) {
        owned.push_back(std::make_shared<OwnedComparison>(
            OwnedComparison{session->shared_file(), nullptr, std::move(comparison)}));
    }
    return owned;
}

/// The options of a sweep.
struct SweepRequest {
    std::vector<std::string> axes; ///< "KEY=[…]"
    std::string case_name;
    std::string folder;
    bool keeps_pixels = false;
    bool verifies = false;
    bool retries_failed = false;
    bool may_replace = false;
    std::string job_text, command, compare_command;
};

/// Tells Python how far a sweep is, and asks it whether Ctrl-C was pressed.
api::SweepWatcher watcher_for(const py::function& tell, bool& is_stopped)
{
    api::SweepWatcher watcher;
    watcher.begin = [&tell](std::uint64_t total, std::uint64_t known) {
        const py::gil_scoped_acquire acquired;
        tell("begin", total, known);
    };
    watcher.advance = [&tell](std::uint64_t done, std::uint64_t failed) {
        const py::gil_scoped_acquire acquired;
        tell("advance", done, failed);
    };
    watcher.should_stop = [&is_stopped] {
        const py::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) {
            PyErr_Clear(); // raised again once the sweep has ended
            is_stopped = true;
        }
        return is_stopped;
    };
    return watcher;
}

void sweep(const std::string& path, const std::string& builtin, const TextPairs& keys,
           const SweepRequest& request, const py::function& tell, std::optional<int> device,
           int threads)
{
    bool is_stopped = false;
    {
        const py::gil_scoped_release released;
        const scene::SweepSpace space{source_of({path, builtin, nullptr}, keys), request.axes,
                                      request.case_name};
        const GlTurn turn{device};
        api::SweepRunOptions options;
        options.folder = request.folder;
        options.keeps_pixels = request.keeps_pixels;
        options.verifies = request.verifies;
        options.retries_failed = request.retries_failed;
        options.may_replace = request.may_replace;
        options.job_text = request.job_text;
        options.command = request.command;
        options.compare_command = request.compare_command;
        options.session = {.device = device, .threads = threads, .context = turn.context()};
        (void)api::sweep(space, options, watcher_for(tell, is_stopped));
    }
    if (is_stopped) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw py::error_already_set();
    }
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

/// Codes as bytes.
template <typename Code>
py::object codes(const scene::Image<Code>& image, py::handle owner)
{
    static_assert(sizeof(Code) == 1);
    return view_of(image, reinterpret_cast<const std::uint8_t*>(image.data()), owner);
}

/// Indices of triangles, −1 for none.
py::object indices(const scene::Image<std::uint32_t>& image, py::handle owner)
{
    return view_of(image, reinterpret_cast<const std::int32_t*>(image.data()), owner);
}

/// Of a lookup's samples one number.
py::object numbers(const scene::Image<scene::LookupSample>& samples, const float* first,
                   py::handle owner)
{
    return view_of(samples, first, owner);
}

/// Every layer by the name that it has in an EXR file, over the comparison's own memory.
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

/// The critical biases of scored lit and blocked pixels, ascending; none without a curve.
py::object curve(const py::object& self)
{
    const Comparison& comparison = self.cast<const OwnedComparison&>().comparison;
    if (!comparison.diagnosis || !comparison.diagnosis->biases) {
        return py::none();
    }
    const analysis::BiasCurve& of_bias = comparison.diagnosis->biases->curve;
    return py::make_tuple(view_of(of_bias.lit(), self), view_of(of_bias.blocked(), self));
}

/// height × width: the middle of the share of the light that a scored pixel sees, else −1.
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
        .def("picture", &picture)
        .def("picture_png", &picture_png);
    py::class_<SweepRequest>(module, "SweepRequest")
        .def(py::init<>())
        .def_readwrite("axes", &SweepRequest::axes)
        .def_readwrite("case_name", &SweepRequest::case_name)
        .def_readwrite("folder", &SweepRequest::folder)
        .def_readwrite("keeps_pixels", &SweepRequest::keeps_pixels)
        .def_readwrite("verifies", &SweepRequest::verifies)
        .def_readwrite("retries_failed", &SweepRequest::retries_failed)
        .def_readwrite("may_replace", &SweepRequest::may_replace)
        .def_readwrite("job_text", &SweepRequest::job_text)
        .def_readwrite("command", &SweepRequest::command)
        .def_readwrite("compare_command", &SweepRequest::compare_command);
    module.def("compare", &compare);
    module.def("sweep", &sweep);
    module.def("evaluate", &evaluate);
}

} // namespace gnomon::python
