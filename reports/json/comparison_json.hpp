#pragma once

#include "analysis/comparison/comparison.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// A comparison as the JSON object that `gnomon compare --json` prints, with a final newline.
///
/// The names and their structure are fixed (docs/json_schema.md), schema 1. What is not known is
/// null: a rate without a denominator, and quantities that were not computed. Text that is no
/// valid UTF-8 (a file's name) has its bad bytes replaced.
[[nodiscard]] std::string comparison_json(const analysis::Comparison& comparison);

/// The same of a job's several lights: what `total_of` sums, then `lights`, each with its name and
/// all that one light's object has.
/// @param lights  at least one.
[[nodiscard]] std::string comparison_json(std::span<const analysis::Comparison> lights);

} // namespace gnomon::reports
