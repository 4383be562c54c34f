#include "analysis/presets/engine_settings.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/metrics/map_results.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/presets/preset_result.hpp"
#include "methods/bias_term.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace gnomon::analysis {
namespace {

/// Biases along the light. An engine with a setting for one of them can express their sum.
constexpr auto along_light =
    std::to_array<std::string_view>({"bias.constant", "bias.constant_m", "bias.constant_texels"});
/// Offsets along the normal, likewise.
constexpr auto along_normal =
    std::to_array<std::string_view>({"bias.normal_texels", "bias.normal_m"});

/// Other keys that change verdicts.
constexpr auto other_keys = std::to_array<std::string_view>(
    {"method.name", "shadow_map.resolution", "shadow_map.layout", "shadow_map.content",
     "shadow_map.depth_format", "shadow_map.cull", "lookup.filter", "lookup.outside"});
/// Those of cascades.
constexpr auto cascade_keys = std::to_array<std::string_view>(
    {"shadow_map.cascades", "shadow_map.split", "shadow_map.split_lambda", "shadow_map.blend"});

bool is_in(std::span<const std::string_view> keys, std::string_view key)
{
    return std::ranges::find(keys, key) != keys.end();
}

/// Empty for a word, or if there is no value.
std::optional<double> number_of(const std::optional<scene::JobValue>& job_value)
{
    if (!job_value) {
        return std::nullopt;
    }
    const scene::JobValue& value = *job_value;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*whole);
    }
    const auto* real = std::get_if<double>(&value);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

/// Translates one job.
class Translation {
public:
    Translation(const scene::Preset& preset, const scene::Job& job, const scene::View& view,
                const EngineReceiver& receiver)
        : preset_{preset},
          job_{job},
          view_{view},
          map_{view.maps.at(receiver.map)},
          texel_m_{map_.texel_width_m(receiver.light_distance_m, job.shadow_map.resolution_texels)},
          along_light_m_{receiver.constant_m +
                         methods::number_in(job, "bias.constant_texels") * texel_m_},
          normal_m_{job.bias.normal_texels * texel_m_ + methods::number_in(job, "bias.normal_m")}
    {
        const bool is_positional = map_.projection == scene::Projection::perspective;
        const double scale = is_positional ? receiver.light_distance_m : 1;
        result_.preset = &preset;
        result_.receiver = receiver;
        result_.width_m = (map_.right_side - map_.left) * scale;
        result_.height_m = (map_.top - map_.bottom) * scale;
        result_.range_m = map_.range_m();
        result_.maps = view.maps.size();
        result_.is_positional = is_positional;
        result_.unit_m = job.scene.unit_m.value_or(1);
        result_.unit = scene::length_unit(job.scene);
    }

    [[nodiscard]] EngineSettings run() &&
    {
        for (const scene::EngineSetting& setting : preset_.engine->settings) {
            if (setting.is_of(job_)) {
                add(setting);
            }
        }
        add_biases_left();
        std::ranges::for_each(other_keys, [&](std::string_view name) { add_key_left(name); });
        if (scene::map_layout(job_) == scene::MapLayout::cascades) {
            std::ranges::for_each(cascade_keys, [&](std::string_view name) { add_key_left(name); });
        }
        return std::move(result_);
    }

private:
    /// The job's value for a key, in the key's unit; lengths in the scene's unit.
    [[nodiscard]] std::optional<scene::JobValue> value_of(const scene::Key& key) const
    {
        const double unit_m = result_.unit_m;
        if (key.name == "bias.constant") {
            return std::copysign(
                bias_of_length(map_, std::abs(along_light_m_), result_.receiver.light_distance_m),
                along_light_m_);
        }
        if (key.name == "bias.constant_m") {
            return along_light_m_ / unit_m;
        }
        if (key.name == "bias.constant_texels") {
            return along_light_m_ / texel_m_;
        }
        if (key.name == "bias.normal_m") {
            return normal_m_ / unit_m;
        }
        if (key.name == "bias.normal_texels") {
            return normal_m_ / texel_m_;
        }
        if (key.name == "shadow_map.near") {
            return map_.near_m / unit_m;
        }
        if (key.name == "shadow_map.far") {
            return map_.far_m / unit_m;
        }
        if (key.name == "shadow_map.cascade_far" && !view_.slices.ends.empty()) {
            return double{view_.slices.ends.back()} / unit_m;
        }
        return scene::engine_key_value(key, job_);
    }

    void add(const scene::EngineSetting& setting)
    {
        const auto value = value_of(*setting.key);
        if (!value) {
            return;
        }
        expressed_.insert(setting.key->name);
        if (setting.second_key != nullptr &&
            number_of(value_of(*setting.second_key)) == number_of(value)) {
            expressed_.insert(setting.second_key->name);
        }
        for (const auto& condition : setting.where) {
            expressed_.insert(condition.first->name);
        }
        if (!setting.words.empty()) {
            const auto word = setting.words.find(scene::engine_word(*value));
            if (word == setting.words.end()) {
                add_left(*setting.key, *value);
            } else {
                result_.values.push_back({&setting, word->second});
            }
            return;
        }
        const double own = setting.times * number_of(*value).value_or(0);
        if (own < setting.least || own > setting.most) {
            result_.cannot.push_back(own > setting.most
                                         ? fmt::format("{} above {:g}; {:.3g} is needed",
                                                       setting.name, setting.most, own)
                                         : fmt::format("{} below {:g}; {:.3g} is needed",
                                                       setting.name, setting.least, own));
            result_.has_all_biases = false;
        }
        result_.values.push_back({&setting, std::clamp(own, setting.least, setting.most) + 0.0,
                                  setting.key->name == "bias.constant" ? along_light_m_ : 0});
    }

    void add_left(const scene::Key& key, const scene::JobValue& value)
    {
        result_.cannot.push_back(fmt::format("{} = {}", key.name, scene::to_toml(value)));
    }

    void add_bias_left(const std::string& bias)
    {
        result_.cannot.push_back(bias);
        result_.has_all_biases = false;
    }

    [[nodiscard]] bool expresses_one_of(std::span<const std::string_view> keys) const
    {
        return std::ranges::any_of(keys,
                                   [&](std::string_view key) { return expressed_.contains(key); });
    }

    /// Lists the job's biases for which the engine has no setting.
    void add_biases_left()
    {
        const auto length = [&](double metres) {
            return fmt::format("{:.2g} {}", metres, result_.unit);
        };
        if (along_light_m_ != 0 && !expresses_one_of(along_light)) {
            add_bias_left(fmt::format("a bias of {} along the light", length(along_light_m_)));
        }
        if (normal_m_ != 0 && !expresses_one_of(along_normal)) {
            add_bias_left(fmt::format("an offset of {} along the normal", length(normal_m_)));
        }
        std::vector<std::string_view> keys = methods::moving_bias_keys(job_);
        keys.emplace_back("bias.slope");
        for (const std::string_view name : keys) {
            const scene::Key* const key = scene::keys_of(job_).find(name);
            if (key == nullptr || expressed_.contains(name) || is_in(along_light, name) ||
                is_in(along_normal, name)) {
                continue;
            }
            const auto value = scene::engine_key_value(*key, job_);
            if (value && !is_default(*key, *value)) {
                add_bias_left(fmt::format("{} = {}", name, scene::to_toml(*value)));
            }
        }
    }

    [[nodiscard]] static bool is_default(const scene::Key& key, const scene::JobValue& value)
    {
        return key.default_value ? value == *key.default_value
                                 : number_of(value) == std::optional{0.0};
    }

    /// Lists a key without a setting, if the job differs from the engine's preset.
    void add_key_left(std::string_view name)
    {
        const scene::Key* const key = scene::keys_of(job_).find(name);
        const auto value = key == nullptr ? std::nullopt : scene::engine_key_value(*key, job_);
        if (!value || expressed_.contains(name)) {
            return;
        }
        const auto own = std::ranges::find_if(
            preset_.job, [&](const scene::Setting& setting) { return setting.spec->name == name; });
        const std::string engines =
            own == preset_.job.end() ? key->default_text : scene::to_toml(own->value);
        if (scene::to_toml(*value) != engines) {
            add_left(*key, *value);
        }
    }

    const scene::Preset& preset_;
    const scene::Job& job_;
    const scene::View& view_;
    const scene::LightFrustum& map_;
    double texel_m_;       ///< at the receiver
    double along_light_m_; ///< of all biases along the light together
    double normal_m_;
    std::set<std::string, std::less<>> expressed_;
    EngineSettings result_;
};

/// @throws scene::InputError  if the engine cannot have the light or the job's method.
void require_translatable(const scene::Preset& preset, const Comparison& comparison)
{
    if (!preset.engine) {
        throw scene::InputError(
            fmt::format("{}: not an engine (`gnomon settings --help`)", preset.name));
    }
    const scene::LightType light = comparison.view.light.type;
    if (!preset.is_for(light)) {
        throw scene::InputError(fmt::format("{}: Gnomon does not know its settings for a {} light",
                                            preset.engine->title, scene::light_type_name(light)));
    }
    const std::string& method = comparison.job.method.name;
    if (!methods::traits(comparison.job).has_map) {
        throw scene::InputError(
            fmt::format("method.name = \"{}\": it has no shadow map to translate", method));
    }
    const auto own = std::ranges::find_if(preset.job, [](const scene::Setting& setting) {
        return setting.spec->name == "method.name";
    });
    const std::string engines =
        own == preset.job.end() ? "depth" : std::get<std::string>(own->value);
    if (method != engines && !(engines == "depth" && method == "pcf")) {
        throw scene::InputError(
            fmt::format("method.name = \"{}\": {} draws maps of the method \"{}\"; set it with "
                        "--set method.name={}",
                        method, preset.engine->title, engines, engines));
    }
}

std::optional<double> rate_of(std::uint64_t count, std::uint64_t of)
{
    return of == 0 ? std::nullopt
                   : std::optional{static_cast<double>(count) / static_cast<double>(of)};
}

} // namespace

scene::Job BiasChoice::job(scene::Job of) const
{
    of.bias.slope = slope ? double{*slope} : of.bias.slope;
    return of;
}

scene::View BiasChoice::view(scene::View of) const
{
    of.bias.slope = slope.value_or(of.bias.slope);
    return of;
}

ChosenBias chosen_bias(const Comparison& comparison, const BiasChoice& choice)
{
    const Metrics& metrics = comparison.metrics;
    const ErrorCounts left = choice.recommended != nullptr
                                 ? choice.recommended->rounded_outcome.errors
                                 : ErrorCounts{metrics.false_shadow, metrics.false_lit};
    ChosenBias chosen;
    chosen.light = comparison.light;
    chosen.is_recommended = choice.recommended != nullptr;
    chosen.was_recommended = choice.was_asked_for;
    chosen.false_shadow_rate =
        rate_of(left.false_shadow, metrics.pixels.of(scene::PixelClass::lit));
    chosen.false_lit_rate = rate_of(left.false_lit, metrics.pixels.of(scene::PixelClass::blocked));
    return chosen;
}

EngineSettings engine_settings(const scene::Preset& preset, const scene::Job& job,
                               const scene::View& view, const EngineReceiver& receiver)
{
    return Translation{preset, job, view, receiver}.run();
}

EngineSettings engine_settings(const scene::Preset& preset, const Comparison& comparison,
                               const BiasChoice& choice)
{
    require_translatable(preset, comparison);
    const auto median = preset_result(comparison, nullptr).receiver;
    if (!median) {
        throw scene::InputError("no pixel is scored, so there is no receiver to translate for");
    }
    EngineReceiver receiver;
    receiver.map = most_read_map(comparison.lookup.maps, comparison.truth.pixel_class);
    receiver.light_distance_m = median->light_distance_m;
    receiver.constant_m =
        bias_in_map(comparison.job, comparison.view, receiver.map, receiver.light_distance_m)
            .constant_m;
    if (choice.recommended != nullptr) {
        receiver.constant_m = choice.recommended->rounded_length.metres;
    }
    EngineSettings settings =
        engine_settings(preset, choice.job(comparison.job), choice.view(comparison.view), receiver);
    ChosenBias chosen = chosen_bias(comparison, choice);
    if (!settings.has_all_biases) {
        chosen.lose_bias();
    }
    static_cast<ChosenBias&>(settings) = std::move(chosen);
    return settings;
}

} // namespace gnomon::analysis
