#pragma once

#include "analysis/presets/preset_result.hpp"
#include "scene/job/presets/engine.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::analysis {

struct Comparison;

/// An engine's setting with the value that matches a job.
struct EngineValue {
    const scene::EngineSetting* setting = nullptr;
    std::variant<double, std::string> value; ///< a number, or one of the engine's words
    /// The length of a bias in depth units along the light's axis [m]; 0 for other settings.
    /// The value depends on near and far; the length does not.
    double length_m = 0;
};

/// A job's shadow map in an engine's settings, and the parts that it cannot express.
struct EngineSettings {
    const scene::Preset* preset = nullptr; ///< whose engine it is; not owned
    std::vector<EngineValue> values;
    std::vector<std::string> cannot; ///< what of the job the engine has no setting for
    double light_distance_m = 0;     ///< of the receiver where lengths were converted
    double range_m = 0;              ///< far − near of the map there
    bool is_exact = true;            ///< lengths hold at every receiver, not only at this one

    std::string light;            ///< name of the one of several; empty: the job has but one
    bool is_recommended = false;  ///< with the recommended constant bias; else the job's own
    std::string_view unit;        ///< of lengths, for people
    double false_shadow_rate = 0; ///< of the lit pixels, in Gnomon's map with these settings [0, 1]
    double false_lit_rate = 0;    ///< of the blocked pixels, likewise
};

/// Translates a job's map, filter and biases into an engine's settings. Biases along the light are
/// added up and given in the setting's own unit, at the median receiver.
/// @param preset    with an engine; outlives the result.
/// @param receiver  where lengths are converted (`bias_at`).
/// Source: docs/presets.md#settings.
[[nodiscard]] EngineSettings engine_settings(const scene::Preset& preset, const scene::Job& job,
                                             const scene::View& view, const ReceiverBias& receiver);

/// The same of what was compared, with what Gnomon's own map leaves.
/// @param recommends  Takes the recommended constant bias in place of the job's own, where one is
///                    recommended.
/// @throws scene::InputError  if the preset is of a lesson or for another kind of light, the light
///                            has no map, or no pixel is scored.
[[nodiscard]] EngineSettings engine_settings(const scene::Preset& preset,
                                             const Comparison& comparison, bool recommends);

} // namespace gnomon::analysis
