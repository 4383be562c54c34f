#pragma once

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"
#include "reports/text/answer_lines.hpp"

#include <vector>

/// Parts of the answer that `answer_text` composes.
namespace gnomon::reports {

/// What to change, what that leaves, which biases are nearly as good, and what it costs; without a
/// known change, what to try.
/// @param comparison  with a diagnosis and errors.
/// @param remedies    `analysis::ranked_remedies` of the comparison.
void add_fix(AnswerLines& lines, const analysis::Comparison& comparison,
             const std::vector<analysis::Remedy>& remedies);

/// The objects with the most wrong pixels, and the middle of the largest patch of them; nothing if
/// no pixel is wrong.
void add_places(AnswerLines& lines, const analysis::Comparison& comparison);

/// Warnings and notes on causes, biases, cascades, the scene and its pixels.
/// @param remedies  as for `add_fix`; empty without a diagnosis.
void add_warnings(AnswerLines& lines, const analysis::Comparison& comparison,
                  const std::vector<analysis::Remedy>& remedies);

/// What only another renderer's frame needs: how well it fits the mesh, and what it cannot tell.
void add_evaluation(AnswerLines& lines, const analysis::Comparison& comparison,
                    const analysis::Evaluation& evaluation);

/// What was asked for besides: GL's reruns, and the float methods for shadow rays.
void add_requested(AnswerLines& lines, const analysis::Comparison& comparison);

} // namespace gnomon::reports
