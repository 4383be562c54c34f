#pragma once

#include "analysis/presets/engine_settings.hpp"
#include "reports/settings/graphics_settings.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/presets/presets.hpp"
#include "store/json.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What `gnomon settings` prints.
namespace gnomon::reports {

/// An engine, or a language or graphics API.
using SettingsTarget = std::variant<scene::Preset, GraphicsTarget>;

/// Every engine, then every language and API; without engines if the table lacks keys of theirs.
[[nodiscard]] std::vector<SettingsTarget> settings_targets(const scene::KeyTable& keys);

/// The names for `--engine`, without aliases.
[[nodiscard]] std::vector<std::string> settings_target_names();

/// @param name   in upper or lower case; an engine may have aliases.
/// @param label  how the message names the choice: "--engine thre".
/// @throws scene::InputError  naming the nearest and all others, if none has that name.
[[nodiscard]] SettingsTarget find_settings_target(const scene::KeyTable& keys,
                                                  std::string_view name, std::string_view label);

/// A job's shadow map, translated.
struct TranslatedSettings {
    std::variant<analysis::EngineSettings, GraphicsSettings> settings;
    /// The configuration of a run that the job is of; empty for a job.
    std::string configuration = {};
    std::string case_name = {}; ///< of the configuration; may be empty
    std::string changed = {};   ///< what the configuration sets among the run's; may be empty
};

/// Translates a comparison.
/// @param target      outlives the result.
/// @param recommends  Takes the biases of the best remedy that changes only biases and that the
///                    target can express whole, if there is one; else the job's own.
/// @throws scene::InputError  as `analysis::engine_settings` and `graphics_settings`.
[[nodiscard]] TranslatedSettings translate(const SettingsTarget& target,
                                           const analysis::Comparison& comparison, bool recommends);

/// "shadows 0.26 % of the lit pixels and lights 1.85 % of the shadowed ones".
/// @param false_shadow  of the lit pixels [0, 1]; empty if unknown.
/// @param false_lit     of the blocked pixels [0, 1]; empty if unknown.
/// @return  Empty if both are unknown.
[[nodiscard]] std::string error_rates_text(const std::optional<double>& false_shadow,
                                           const std::optional<double>& false_lit);

/// Lines to paste into the engine's code, what they mean, and what the engine cannot be told.
[[nodiscard]] std::string settings_text(std::span<const TranslatedSettings> translated);

/// One translation as a JSON object (docs/json_schema.md#engine-settings).
[[nodiscard]] store::Json settings_object(const TranslatedSettings& translated);

/// The objects of all, as `gnomon settings --json` prints them.
[[nodiscard]] std::string settings_json(std::span<const TranslatedSettings> translated);

} // namespace gnomon::reports
