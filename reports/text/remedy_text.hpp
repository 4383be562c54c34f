#pragma once

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// Whether all that is told of the job and of a remedy are counts: neither has verdicts that are
/// fractions.
[[nodiscard]] bool is_counted(const analysis::Comparison& comparison,
                              const analysis::Remedy& remedy);

/// "bias.constant = 0.0075 (0.21 m, 3 texels)": what changes, and what a bias amounts to.
/// @param unit  of lengths, as `length_unit` has it.
[[nodiscard]] std::string remedy_keys(const analysis::Remedy& remedy, std::string_view unit = "m");

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
