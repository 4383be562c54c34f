#include "reports/words/findings.hpp"

#include "analysis/advice/remedies.hpp"
#include "reports/words/error_words.hpp"
#include "reports/words/recommendation_words.hpp"
#include "reports/words/remedy_words.hpp"
#include "reports/words/text.hpp"

#include <fmt/format.h>

#include <utility>

namespace gnomon::reports {

namespace {

void append(std::vector<std::string>& sentences, std::string sentence)
{
    if (!sentence.empty()) {
        sentences.push_back(std::move(sentence));
    }
}

/// What of the map to look at, where no remedy is known.
std::string hint(const analysis::Comparison& comparison)
{
    const std::string to_try = what_to_try(comparison);
    if (!comparison.advice.empty()) {
        return fmt::format("None of {} leaves less.",
                           counted(comparison.advice.size(), "measured change"));
    }
    if (to_try.empty() || comparison.evaluation || !comparison.diagnosis->biases) {
        return to_try.empty() ? "" : to_try + ".";
    }
    return to_try + "; --advise measures it.";
}

/// That the first remedy, the recommended bias, is long; empty where it is short or another.
std::string warning(const analysis::Comparison& comparison,
                    const std::vector<analysis::Remedy>& remedies)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    const bool is_first = recommended && !remedies.empty() &&
                          remedies.front().keys == std::vector{recommended->pasted.key};
    return is_first ? long_bias(comparison).value_or("") : "";
}

} // namespace

std::vector<std::string> errors_in_words(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{what_is_wrong(comparison)};
    append(sentences, what_it_comes_from(comparison));
    if (sentences.size() > 1) {
        const std::string to_try = what_to_try(comparison);
        append(sentences, to_try.empty() ? "" : to_try + ".");
    }
    return sentences;
}

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{what_is_wrong(comparison)};
    std::string causes = what_it_comes_from(comparison);
    if (causes.empty()) {
        return sentences;
    }
    const auto remedies = analysis::ranked_remedies(comparison);
    append(sentences,
           remedies.empty() ? hint(comparison) : remedy_sentence(comparison, remedies.front()));
    append(sentences, warning(comparison, remedies));
    append(sentences, std::move(causes));
    append(sentences, why_none_serves(comparison));
    return sentences;
}

} // namespace gnomon::reports
