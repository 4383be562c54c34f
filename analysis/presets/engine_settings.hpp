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

/// A setting of an engine with the value that does what a job does.
struct EngineValue {
    const scene::EngineSetting* setting = nullptr;
    std::variant<double, std::string> value; ///< a number, or one of the engine's words
    /// Of a bias along the light in depth units: its length along the light's axis [m]; else 0.
    /// With another near or far plane the same length is another value.
    double length_m = 0;
};

/// What an engine must be told to do what a job does, and what it cannot be told.
struct EngineSettings {
    const scene::Preset* preset = nullptr; ///< whose engine it is; not owned
    std::vector<EngineValue> values;
    std::vector<std::string> cannot; ///< what of the job the engine has no setting for
    double light_distance_m = 0;     ///< of the receiver where lengths were converted
    double range_m = 0;              ///< far − near of the map there
    bool is_exact = true; ///< the lengths are the same at every receiver; else at this one

    std::string light;            ///< name of the one of several; empty: the job has but one
    bool is_recommended = false;  ///< with the recommended constant bias; else the job's own
    std::string_view unit;        ///< of lengths, for people
    double false_shadow_rate = 0; ///< of the lit pixels, in Gnomon's map with these settings [0, 1]
    double false_lit_rate = 0;    ///< of the blocked pixels, the same
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
