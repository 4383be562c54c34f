#include "analysis/presets/engine_settings.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/comparison/comparison.hpp"
#include "methods/bias_term.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string_view>
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
    {"method.name", "shadow_map.layout", "shadow_map.content", "shadow_map.depth_format",
     "shadow_map.cull", "shadow_map.reversed", "lookup.filter", "lookup.outside"});

bool is_in(std::span<const std::string_view> keys, std::string_view key)
{
    return std::ranges::find(keys, key) != keys.end();
}

std::string written(const scene::JobValue& value)
{
    const auto* word = std::get_if<std::string>(&value);
    return word != nullptr ? *word : scene::to_toml(value);
}

std::optional<double> number_of(const scene::JobValue& value)
{
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
                const ReceiverBias& receiver)
        : preset_{preset},
          job_{job},
          map_{view.first_map()},
          receiver_{receiver}
    {
        const double texels = methods::number_in(job, "bias.constant_texels");
        const double length_m = receiver.bias.constant_m + texels * receiver.texel_m;
        along_light_m_ = length_m;
        normal_m_ =
            receiver.normal_texels * receiver.texel_m + methods::number_in(job, "bias.normal_m");
        result_.preset = &preset;
        result_.light_distance_m = receiver.light_distance_m;
        result_.range_m = map_.range_m();
        result_.is_exact =
            map_.projection == scene::Projection::orthographic && view.maps.size() == 1;
    }

    [[nodiscard]] EngineSettings run() &&
    {
        for (const scene::EngineSetting& setting : preset_.engine->settings) {
            if (setting.is_of(job_)) {
                add(setting);
            }
        }
        add_biases_left();
        for (const std::string_view name : other_keys) {
            add_key_left(name);
        }
        return std::move(result_);
    }

private:
    /// The job's value for a key, in the key's unit.
    [[nodiscard]] std::optional<scene::JobValue> value_of(const scene::Key& key) const
    {
        if (key.name == "bias.constant") {
            return along_light_m_ == receiver_.bias.constant_m
                       ? receiver_.bias.constant
                       : bias_of_length(map_, along_light_m_, receiver_.light_distance_m);
        }
        if (key.name == "bias.constant_m") {
            return along_light_m_ / job_.scene.unit_m.value_or(1);
        }
        if (key.name == "bias.constant_texels") {
            return along_light_m_ / receiver_.texel_m;
        }
        if (key.name == "bias.normal_m") {
            return normal_m_ / job_.scene.unit_m.value_or(1);
        }
        if (key.name == "bias.normal_texels") {
            return normal_m_ / receiver_.texel_m;
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
        if (!setting.words.empty()) {
            const auto word = setting.words.find(written(*value));
            if (word == setting.words.end()) {
                add_left(*setting.key, *value);
            } else {
                result_.values.push_back({&setting, word->second});
            }
            return;
        }
        const double own = setting.times * number_of(*value).value_or(0);
        if (own < setting.least || own > setting.most) {
            result_.cannot.push_back(fmt::format("{} = {:.3g}, for it takes {:g} to {:g}",
                                                 setting.name, own, setting.least, setting.most));
        }
        result_.values.push_back({&setting, std::clamp(own, setting.least, setting.most) + 0.0,
                                  setting.key->name == "bias.constant" ? along_light_m_ : 0});
    }

    void add_left(const scene::Key& key, const scene::JobValue& value)
    {
        result_.cannot.push_back(fmt::format("{} = {}", key.name, scene::to_toml(value)));
    }

    [[nodiscard]] bool expresses_one_of(std::span<const std::string_view> keys) const
    {
        return std::ranges::any_of(keys,
                                   [&](std::string_view key) { return expressed_.contains(key); });
    }

    /// Lists the job's biases for which the engine has no setting.
    void add_biases_left()
    {
        if (along_light_m_ != 0 && !expresses_one_of(along_light)) {
            result_.cannot.push_back(fmt::format("a bias of {:.2g} {} along the light",
                                                 along_light_m_, scene::length_unit(job_.scene)));
        }
        if (normal_m_ != 0 && !expresses_one_of(along_normal)) {
            result_.cannot.push_back(fmt::format("an offset of {:.2g} {} along the normal",
                                                 normal_m_, scene::length_unit(job_.scene)));
        }
        std::vector<std::string_view> keys = methods::moving_bias_keys(job_);
        keys.push_back("bias.slope");
        for (const std::string_view name : keys) {
            const scene::Key* const key = scene::keys_of(job_).find(name);
            if (key == nullptr || expressed_.contains(name) || is_in(along_light, name) ||
                is_in(along_normal, name)) {
                continue;
            }
            const auto value = scene::engine_key_value(*key, job_);
            if (value && number_of(*value).value_or(0) != 0) {
                add_left(*key, *value);
            }
        }
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
    const scene::LightFrustum& map_;
    const ReceiverBias& receiver_;
    double along_light_m_ = 0; ///< of all biases along the light together
    double normal_m_ = 0;
    std::set<std::string, std::less<>> expressed_;
    EngineSettings result_;
};

} // namespace

EngineSettings engine_settings(const scene::Preset& preset, const scene::Job& job,
                               const scene::View& view, const ReceiverBias& receiver)
{
    return Translation{preset, job, view, receiver}.run();
}

EngineSettings engine_settings(const scene::Preset& preset, const Comparison& comparison,
                               bool recommends)
{
    const scene::LightType light = comparison.view.light.type;
    if (!preset.engine) {
        throw scene::InputError(
            fmt::format("{}: no engine; name one of them (`gnomon settings --help`)", preset.name));
    }
    if (!preset.is_for(light)) {
        throw scene::InputError(
            fmt::format("{}: its settings under a {} light are not known to Gnomon",
                        preset.engine->title, scene::light_type_name(light)));
    }
    auto receiver = preset_result(comparison, nullptr).receiver;
    if (!receiver) {
        throw scene::InputError(
            "nothing to translate: the light has no map, or no pixel is scored");
    }
    const auto& recommended = comparison.diagnosis ? comparison.diagnosis->curve.recommended
                                                   : std::optional<Recommendation>{};
    const Metrics& metrics = comparison.metrics;
    double false_shadow = metrics.false_shadow_rate.value_or(0);
    double false_lit = metrics.false_lit_rate.value_or(0);
    if (recommends && recommended) {
        receiver->bias.constant = double{recommended->rounded.bias};
        receiver->bias.constant_m = recommended->rounded_length.metres;
        receiver->bias.constant_texels = recommended->rounded_length.texels;
        const auto rate = [](std::uint64_t count, std::uint64_t of) {
            return of == 0 ? 0 : static_cast<double>(count) / static_cast<double>(of);
        };
        const ErrorCounts& left = recommended->rounded_outcome.errors;
        false_shadow = rate(left.false_shadow, metrics.pixels.of(scene::PixelClass::lit));
        false_lit = rate(left.false_lit, metrics.pixels.of(scene::PixelClass::blocked));
    }
    EngineSettings settings = engine_settings(preset, comparison.job, comparison.view, *receiver);
    settings.light = comparison.light;
    settings.is_recommended = recommends && recommended.has_value();
    settings.unit = scene::length_unit(comparison.job.scene);
    settings.false_shadow_rate = false_shadow;
    settings.false_lit_rate = false_lit;
    return settings;
}

} // namespace gnomon::analysis
