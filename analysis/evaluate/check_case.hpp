#pragma once

#include "analysis/evaluate/checked_case.hpp"
#include "renderers/reference.hpp"

#include <optional>

namespace gnomon::analysis {

/// Checks a case, and finds the truth of its pixels.
/// @param tolerance_m  of the 99th percentile of distances; empty: `default_tolerance_m`.
/// @throws scene::InputError  if the light or camera is not valid, or `objects` names no object.
[[nodiscard]] CheckedCase check_case(const Case& subject, const renderers::RoundedReference& truth,
                                     std::optional<double> tolerance_m);

} // namespace gnomon::analysis
