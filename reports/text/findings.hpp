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

/// Two sentences: where the bias lies in the interval, and which shadows it removes.
[[nodiscard]] std::vector<std::string> bias_sentences(const RecommendedLengths& recommended);

/// That the recommended bias removes visible shadows, and which slope bias would allow a smaller
/// one without more error; empty if the bias is short, or none is recommended.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::optional<std::string> long_bias(const analysis::Comparison& comparison);

/// `bias_sentences` of the comparison's recommendation, then `long_bias`; empty if no bias is
/// recommended.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::vector<std::string>
recommendation_sentences(const analysis::Comparison& comparison);

} // namespace gnomon::reports
