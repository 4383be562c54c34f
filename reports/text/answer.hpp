#pragma once

#include "analysis/comparison/comparison.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// How an answer is shown, and the command that it names.
struct AnswerOptions {
    bool in_colour = false; ///< with a terminal's escape sequences
    /// "gnomon settings --builtin columns", which translates the fix; empty: the answer names none.
    std::string settings_command = {};
};

/// The answer that `gnomon compare` and `evaluate` print: what is wrong, how much, what mends it
/// and at what cost, other ways, where to look, warnings, the settings, and what to do next. At
/// most 14 lines of 110 columns unless warnings or measured changes need more. Numbers have two or
/// three digits.
/// @param comparison  without a diagnosis the answer has counts alone.
[[nodiscard]] std::string answer_text(const analysis::Comparison& comparison,
                                      const AnswerOptions& options);

/// An answer for each of several lights, headed by the light's name, and a line of totals.
/// @param lights  at least one.
[[nodiscard]] std::string answer_text(std::span<const analysis::Comparison> lights,
                                      const AnswerOptions& options);

} // namespace gnomon::reports
