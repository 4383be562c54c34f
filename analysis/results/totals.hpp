#pragma once

#include "analysis/results/results.hpp"

#include <span>

namespace gnomon::analysis {

/// The sum of several lights' results: every pair of a pixel and a light counts. Rates are those of
/// the summed counts; causes are known if every light's are; of the lengths of
/// peter-panning, which are quantiles, the number alone is known; errors by part are left out.
[[nodiscard]] ConfigurationResult total_of(std::span<const ConfigurationResult> results);

} // namespace gnomon::analysis
