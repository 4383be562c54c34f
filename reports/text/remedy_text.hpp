#pragma once

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// Whether counts suffice to describe the job and the remedy: neither has fractional verdicts.
[[nodiscard]] bool is_counted(const analysis::Comparison& comparison,
                              const analysis::Remedy& remedy);

/// The changed keys, and a bias as lengths: "bias.constant = 0.0075 (0.21 m, 3 texels)".
/// @param unit  of lengths, as `length_unit` returns it.
[[nodiscard]] std::string remedy_keys(const analysis::Remedy& remedy, std::string_view unit = "m");

/// The changed keys as a fragment of a job file, one per line.
[[nodiscard]] std::string remedy_toml(const analysis::Remedy& remedy);

/// The errors that remain: "bias.constant = 0.0075 (0.21 m, 3 texels) leaves 0.30 % of the surface
/// wrong, in place of 32.1 %."
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string remedy_sentence(const analysis::Comparison& comparison,
                                          const analysis::Remedy& remedy);

/// The same without the keys, for an answer: "0.30 % wrong, from 32.1 %."
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string remedy_effect(const analysis::Comparison& comparison,
                                        const analysis::Remedy& remedy);

/// One of several changes, for a list: "bias.constant = 0.0075 (0.21 m, 3 texels): leaves 0.30 %,
/// 4 MiB".
/// @param comparison  with a diagnosis.
[[nodiscard]] std::string remedy_in_brief(const analysis::Comparison& comparison,
                                          const analysis::Remedy& remedy);

/// "; more pixels are wrong": what the change makes worse; empty if nothing.
[[nodiscard]] std::string worsening_text(const analysis::Comparison& comparison,
                                         const analysis::Remedy& remedy);

/// "4 MiB"
[[nodiscard]] std::string mebibytes(std::uint64_t bytes);

} // namespace gnomon::reports
