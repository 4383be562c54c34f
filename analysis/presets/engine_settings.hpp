#pragma once

#include "scene/job/presets/presets.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::analysis {

struct Comparison;
struct Recommendation;

/// The constant bias that is translated, and the errors of Gnomon's own map with it.
struct ChosenBias {
    std::string light;            ///< name of one of several lights; empty for the only one
    bool is_recommended = false;  ///< recommended biases, not the job's own
    bool was_recommended = false; ///< whether a recommended bias was asked for
    /// Error rates of lit and of blocked pixels [0, 1]; empty without such pixels.
    std::optional<double> false_shadow_rate;
    std::optional<double> false_lit_rate;
    bool has_all_biases = true; ///< false: a bias is not translated, and no error rate is known

    /// Notes that a bias of the job is not translated.
    void lose_bias()
    {
        has_all_biases = false;
        false_shadow_rate.reset();
        false_lit_rate.reset();
    }
};

/// Biases to translate: a recommendation, or the job's own.
struct BiasChoice {
    const Recommendation* recommended = nullptr; ///< not owned; null: the job's own biases
    std::optional<float> slope = {};             ///< of the recommendation; empty: the job's own
    bool was_asked_for = false;                  ///< whether a recommendation was asked for

    /// The job, or the view, with the slope.
    [[nodiscard]] scene::Job job(scene::Job of) const;
    [[nodiscard]] scene::View view(scene::View of) const;
};

/// The choice and the error rates that it leaves in Gnomon's own map.
[[nodiscard]] ChosenBias chosen_bias(const Comparison& comparison, const BiasChoice& choice);

/// An engine's setting with the value that matches a job.
struct EngineValue {
    const scene::EngineSetting* setting = nullptr;
    std::variant<double, std::string> value; ///< a number, or one of the engine's words
    /// The length of a bias in depth units along the light's axis [m]; 0 for other settings.
    /// The value depends on the map's planes; the length does not.
    double length_m = 0;
};

/// The receiver where lengths are converted: the median one of the map that most receivers read.
struct EngineReceiver {
    std::size_t map = 0;         ///< index among the view's maps
    double light_distance_m = 0; ///< > 0 for a spot
    /// Length of the constant bias along the light's axis there [m].
    double constant_m = 0;
};

/// A job's shadow map in an engine's settings, and the parts that it cannot express.
struct EngineSettings : ChosenBias {
    const scene::Preset* preset = nullptr; ///< whose engine it is; not owned
    std::vector<EngineValue> values;
    std::vector<std::string> cannot; ///< parts of the job for which the engine has no setting
    EngineReceiver receiver;
    double width_m = 0; ///< sides of the receiver's map, at the receiver [m]
    double height_m = 0;
    double range_m = 0; ///< far − near of that map
    std::size_t maps = 1;
    bool is_positional = false; ///< lengths hold at the receiver alone
    double unit_m = 1;          ///< the scene's unit, in which engines count
    std::string_view unit;      ///< of metres, for people
};

/// Translates a job's map, filter and biases into an engine's settings. Biases along the light are
/// added up and given in the setting's own unit.
/// @param preset  with an engine; outlives the result.
/// Source: docs/presets.md#settings.
[[nodiscard]] EngineSettings engine_settings(const scene::Preset& preset, const scene::Job& job,
                                             const scene::View& view,
                                             const EngineReceiver& receiver);

/// The same for a comparison, with the error rates of Gnomon's own map.
/// @throws scene::InputError  if the preset has no engine or does not support the light or the
///                            job's method, the light has no map, or no pixel is scored.
[[nodiscard]] EngineSettings engine_settings(const scene::Preset& preset,
                                             const Comparison& comparison,
                                             const BiasChoice& choice);

} // namespace gnomon::analysis
