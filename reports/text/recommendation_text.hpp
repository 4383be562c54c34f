#pragma once

#include "analysis/comparison/comparison.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What is said of a recommended constant bias.
namespace gnomon::reports {

/// A constant bias that is recommended, and the valley that it is of.
struct RecommendedLengths {
    analysis::BiasLength bias;
    analysis::BiasLength low;
    analysis::BiasLength high; ///< infinite: nothing limits it
    analysis::Margin margin = analysis::Margin::whole;
    std::string_view unit = "m"; ///< of lengths, as `length_unit` has it
};

/// How the bias lies among those that are nearly as good, and which shadows it takes away: two
/// sentences.
[[nodiscard]] std::vector<std::string> bias_sentences(const RecommendedLengths& recommended);

/// That the recommended bias takes away shadows that one sees, and with which slope a smaller one
/// leaves no more error; empty where it is short, or nothing is recommended.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::optional<std::string> long_bias(const analysis::Comparison& comparison);

/// All that is said of what a comparison recommends: the two sentences, and that the bias is long
/// where it is. Empty where nothing is recommended.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::vector<std::string>
recommendation_sentences(const analysis::Comparison& comparison);

} // namespace gnomon::reports
