#include "cli/renderer/driven_renderer.hpp"

#include "analysis/evaluate/evaluate.hpp"
#include "cli/renderer/protocol/renderer_frame.hpp"
#include "cli/system/process.hpp"
#include "reference_rt/truth.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <utility>

namespace gnomon::cli {
bool LastMask::take(const scene::Image<float>& mask, const std::string& opened)
{
    bool is_again = opened != opened_ && mask.size() == mask_.size();
    for (std::size_t i = 0; is_again && i < mask.pixel_count(); ++i) {
        is_again = std::bit_cast<std::uint32_t>(mask[i]) == std::bit_cast<std::uint32_t>(mask_[i]);
    }
    mask_ = mask;
    opened_ = opened;
    return is_again;
}

bool LastMask::must_differ(const analysis::Metrics& measured)
{
    constexpr std::uint64_t parts = 100;
    const std::uint64_t blocked = measured.pixels.of(scene::PixelClass::blocked);
    const std::uint64_t lit = measured.pixels.of(scene::PixelClass::lit);
    const bool lights_all = measured.false_shadow == 0 && measured.false_lit == blocked;
    const bool lights_none = measured.false_lit == 0 && measured.false_shadow == lit;
    const std::uint64_t before = std::exchange(blocked_, blocked);
    const std::uint64_t change = std::max(before, blocked) - std::min(before, blocked);
    return !lights_all && !lights_none && parts * change > lit + blocked;
}

namespace {

constexpr std::string_view engine_table = "engine.";

/// The job's scene.* keys as text.
std::string scene_key_of(const scene::Job& job)
{
    std::string text;
    for (const auto& [key, value] : scene::resolved_keys(job)) {
        if (key.starts_with("scene.")) {
            text += fmt::format("{} = {}\n", key, value);
        }
    }
    return text;
}

bool same_space(const scene::CaseSpace& a, const scene::CaseSpace& b)
{
    return a.axes == b.axes && a.units_per_mesh_unit == b.units_per_mesh_unit;
}

/// Adds the keys that were sent to the renderer, and those of the scene and the engine.
void add_sent_keys(std::vector<std::string>& keys, const scene::Job& job,
                   const std::vector<std::string>& given)
{
    const auto add = [&](const std::string& key) {
        if (std::ranges::find(keys, key) == keys.end()) {
            keys.push_back(key);
        }
    };
    std::ranges::for_each(given, add);
    for (const auto& [key, value] : scene::resolved_keys(job)) {
        if (key.starts_with("scene.") || key.starts_with(engine_table)) {
            add(key);
        }
    }
}

} // namespace

EngineValues engine_values(const scene::Job& job)
{
    EngineValues values;
    for (const scene::Key& key : scene::keys_of(job).rows()) {
        if (key.name.starts_with(engine_table)) {
            values[key.name.substr(engine_table.size())] = key.value_of(job.method);
        }
    }
    return values;
}

std::vector<scene::Key> engine_keys(const RendererHello& hello)
{
    std::vector<scene::Key> keys;
    for (const EngineKey& key : hello.keys) {
        keys.push_back(scene::added_key(
            scene::make_key(std::string{engine_table} + key.name,
                            key.unit.empty() ? key.help : key.help + " [{unit}]", "",
                            scene::Stage::shadow_map | scene::Stage::lookup, key.unit),
            key.domain, key.default_value, {}));
    }
    return keys;
}

DrivenRenderer::DrivenRenderer(RendererSettings settings) : settings_{std::move(settings)}
{
    start();
    hello_ = client_->hello();
}

void DrivenRenderer::start()
{
    client_.reset();
    opened_.clear();
    failed_to_start_ = true;
    client_.emplace(settings_.command, settings_.parent, settings_.longest);
    failed_to_start_ = false;
    if (!hello_.name.empty() && client_->hello().title() != hello_.title()) {
        const std::string now = client_->hello().title();
        client_->fail("hello", fmt::format("started again, it says that it is {}; it was {}", now,
                                           hello_.title()));
    }
}

const scene::SceneFile& DrivenRenderer::load(const scene::Job& job)
{
    std::string key = scene_key_of(job);
    if (key != scene_key_ || file_.scene.triangles.empty()) {
        file_ = scene::load_scene(job.scene);
        scene_key_ = std::move(key);
        mesh_.reset();
        opened_.clear();
    }
    return file_;
}

void DrivenRenderer::open(const RendererScene& scene)
{
    const std::string wanted = open_request(scene, "").dump();
    if (wanted != opened_) {
        opened_.clear();
        client_->open(scene);
        opened_ = wanted;
    }
}

RendererFrame DrivenRenderer::draw(const RendererDraw& draw)
{
    RendererFrame frame = client_->draw(draw);
    if (!was_drawn_twice_) {
        const RendererFrame again = client_->draw(draw);
        frame.seconds = again.seconds; // the first frame's time includes compiling and loading
        if (const std::string difference = frame_difference(frame.layers, again.layers);
            !difference.empty()) {
            client_->fail("draw", fmt::format("two equal requests gave frames that are not equal: "
                                              "{}: its errors cannot be measured",
                                              difference));
        }
        was_drawn_twice_ = true;
    }
    return frame;
}

const api::CaseMesh& DrivenRenderer::mesh()
{
    if (!mesh_ || !same_space(mesh_space_, client_->space())) {
        mesh_space_ = client_->space();
        mesh_ = std::make_unique<api::CaseMesh>(file_.scene, mesh_space_, settings_.threads);
    }
    return *mesh_;
}

analysis::Comparison DrivenRenderer::evaluate(const scene::Job& job,
                                              const std::vector<std::string>& given,
                                              RendererFrame frame)
{
    const api::CaseMesh& mesh = this->mesh();
    const double seconds = frame.seconds;
    const bool is_again = last_mask_.take(frame.layers.mask, opened_);
    constexpr std::string_view old_frame = "an old frame: its mask equals the last one bit by bit";
    const api::LoadedCase loaded{std::move(frame.file), std::move(frame.layers), mesh};
    analysis::CheckedCase checked = loaded.check(std::nullopt);
    if (!checked.check.mistake.empty()) {
        client_->fail("draw", is_again ? fmt::format("{}; {}", old_frame, checked.check.sentence)
                                       : checked.check.sentence);
    }
    analysis::Comparison result = loaded.evaluate(std::move(checked));
    if (last_mask_.must_differ(result.metrics) && is_again) {
        client_->fail("draw", fmt::format("{}, but the exact shadow differs", old_frame));
    }
    result.job.scene = job.scene;
    for (const auto& [key, value] : job.method.values) {
        if (key.starts_with(engine_table)) {
            result.job.method.values[key] = value;
        }
    }
    result.scene.name = analysis::scene_name(job.scene);
    result.evaluation->frame_s = seconds;
    add_sent_keys(result.evaluation->given_keys, job, given);
    return result;
}

analysis::Comparison DrivenRenderer::compare(const scene::Job& job,
                                             const std::vector<std::string>& given)
{
    const scene::SceneFile& file = load(job);
    const scene::View view = scene::resolve_view(job, file.scene, file.defaults);
    try {
        if (!client_) {
            start();
        }
        open({analysis::scene_name(job.scene), file.scene,
              scene::resolve_camera(job, file.scene, file.defaults),
              scene::resolve_light(job, file.defaults), job.image});
        return evaluate(job, given, draw({job, view, given, engine_values(job)}));
    } catch (const RendererFailure&) {
        client_.reset();
        throw;
    }
}

void DrivenRenderer::close()
{
    if (!client_) {
        return;
    }
    try {
        client_->close();
    } catch (const RendererFailure& failure) {
        fmt::print(stderr, "gnomon: {}; what it drew was complete before\n", failure.what());
    }
    client_.reset();
}

analysis::Environment DrivenRenderer::environment() const
{
    return {hello_.title(), std::string{analysis::Environment::other_renderer},
            reference_rt::embree_version(), GNOMON_VERSION};
}

RendererSettings renderer_settings(RendererCommand command, const RendererOptions& options,
                                   int threads)
{
    return {std::move(command), temporary_folder(), options.longest(), threads};
}

scene::JobSource read_driven_job(const DrivenRenderer& renderer, const JobOptions& options)
{
    JobOptions of_engine = options;
    of_engine.keys = options.keys->with_engine_keys(engine_keys(renderer.hello()));
    scene::JobSource source = read_any_job_source(of_engine);
    if (!source.lights.empty()) {
        throw scene::InputError(
            fmt::format("{}: another renderer draws one light at a time: choose one with --light, "
                        "{}",
                        source.name, fmt::join(source.lights, " or ")));
    }
    return source;
}

scene::SweepSpace space_of_one(scene::JobSource source, const std::string& case_name)
{
    source.sweep = {};
    if (case_name.empty()) {
        source.cases.clear();
    }
    return scene::SweepSpace{std::move(source), {}, case_name};
}

void refuse_for_renderer(std::initializer_list<std::pair<std::string_view, bool>> options)
{
    for (const auto& [name, is_given] : options) {
        if (is_given) {
            throw scene::InputError(
                fmt::format("{} is only for GL's shadows: remove it, or the renderer", name));
        }
    }
}

std::vector<std::string> key_names(const std::vector<std::pair<std::string, std::string>>& keys)
{
    std::vector<std::string> names;
    for (const auto& [key, value] : keys) {
        names.push_back(key);
    }
    return names;
}

} // namespace gnomon::cli
