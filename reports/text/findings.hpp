#pragma once

#include "analysis/comparison/comparison.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// The errors of a shadow map, the cheapest change that cures most of them and the errors it
/// leaves, and the causes: one sentence each. All numbers are measured, or exact by the bias curve;
/// none is predicted. Empty without a diagnosis.
[[nodiscard]] std::vector<std::string> findings(const analysis::Comparison& comparison);

/// Whether any scored pixel is in error, apart from what a kernel softens on purpose.
/// @param comparison  with a diagnosis.
[[nodiscard]] bool has_errors(const analysis::Comparison& comparison);

/// Whether the first remedy is the recommended constant bias alone.
/// @param comparison  with a diagnosis.
/// @param remedies    `analysis::ranked_remedies` of the comparison.
[[nodiscard]] bool recommends_constant_bias(const analysis::Comparison& comparison,
                                            const std::vector<analysis::Remedy>& remedies);

/// What to say where no change is known to help; may be empty.
/// @param comparison  with a diagnosis and errors.
[[nodiscard]] std::string hint_sentence(const analysis::Comparison& comparison);

/// What to know before changing the job: that the recommended bias is long, that other biases,
/// float32 positions or unread cascades matter, or that no constant bias serves.
/// @param comparison  with a diagnosis.
/// @param remedies    `analysis::ranked_remedies` of the comparison.
[[nodiscard]] std::vector<std::string>
warning_sentences(const analysis::Comparison& comparison,
                  const std::vector<analysis::Remedy>& remedies);

/// The errors, their causes, and map settings that would reduce them: one sentence each. Empty
/// without a diagnosis.
[[nodiscard]] std::vector<std::string> errors_as_text(const analysis::Comparison& comparison);

/// A recommended constant bias, and the interval of biases that are nearly as good.
struct RecommendedLengths {
    analysis::BiasLength bias;
    analysis::BiasLength low;
    analysis::BiasLength high; ///< infinite: nothing limits it
    analysis::Margin margin = analysis::Margin::whole;
    std::string_view unit = "m"; ///< of lengths, as `length_unit` returns it
};

/// Which shadows a constant bias removes: "A caster whose lit side is nearer than 0.21 m to a
/// surface, along the light's axis, casts no shadow there."
/// @param unit  of lengths, as `length_unit` returns it.
[[nodiscard]] std::string caster_sentence(const analysis::BiasLength& bias, std::string_view unit);

/// Two sentences: where the bias lies in the interval, and which shadows it removes.
[[nodiscard]] std::vector<std::string> bias_sentences(const RecommendedLengths& recommended);

/// That the recommended bias removes visible shadows, and which slope bias would allow a smaller
/// one without more error; empty if the bias is short, or none is recommended.
/// @param comparison   with a diagnosis.
/// @param names_slope  false: leave out the slope bias.
[[nodiscard]] std::optional<std::string> long_bias(const analysis::Comparison& comparison,
                                                   bool names_slope = true);

/// `bias_sentences` of the comparison's recommendation, then `long_bias`; empty if no bias is
/// recommended.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::vector<std::string>
recommendation_sentences(const analysis::Comparison& comparison);

} // namespace gnomon::reports
