#pragma once

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// "bias.constant = 0.0075 (0.21 m, 3 texels)": what changes, and what a bias amounts to.
[[nodiscard]] std::string remedy_keys(const analysis::Remedy& remedy);

/// The keys that change as a fragment of a job file, a line each.
[[nodiscard]] std::string remedy_toml(const analysis::Remedy& remedy);

/// What a remedy leaves: "bias.constant = 0.0075 (0.21 m, 3 texels) leaves 0.30 % of the surface
/// wrong, in place of 32.1 %."
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string remedy_sentence(const analysis::Comparison& comparison,
                                          const analysis::Remedy& remedy);

/// "4 MiB"
[[nodiscard]] std::string mebibytes(std::uint64_t bytes);

} // namespace gnomon::reports
