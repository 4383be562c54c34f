#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/settings/settings_text.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A comparison as the JSON object that `gnomon compare --json` prints, with a final newline.
///
/// Names and structure are fixed (docs/json_schema.md), schema 1. Unknown values are null: rates
/// without a denominator, and quantities that were not computed. Invalid UTF-8, as in file names,
/// is replaced.
[[nodiscard]] std::string comparison_json(const analysis::Comparison& comparison);

/// The JSON that a run keeps with a configuration's layers (docs/runs.md): `comparison_json` with
/// `headline` and, for Gnomon's own maps, `engine_settings`: the settings with the recommended bias
/// for each target that can have them.
[[nodiscard]] std::string kept_json(const analysis::Comparison& comparison,
                                    std::span<const SettingsTarget> targets);

/// The JSON object of a job with several lights: the totals, then `lights`, each with its name and
/// the members of its own comparison.
/// @param lights  at least one.
[[nodiscard]] std::string comparison_json(std::span<const analysis::Comparison> lights);

/// The JSON that `gnomon evaluate --check --json` prints, with a final newline.
[[nodiscard]] std::string check_json(const analysis::ImportCheck& check);

} // namespace gnomon::reports
