#include "reports/text/findings.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/advice/remedies.hpp"
#include "analysis/metrics/map_facts.hpp"
#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/error_text.hpp"
#include "reports/text/recommendation_text.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/shares.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

void append(std::vector<std::string>& sentences, std::string sentence)
{
    if (!sentence.empty()) {
        sentences.push_back(std::move(sentence));
    }
}

/// Whether `--advise` could measure what was not measured: of Gnomon's own maps.
bool can_advise(const analysis::Comparison& comparison)
{
    return comparison.advice.empty() && !comparison.evaluation &&
           methods::traits(comparison.job).has_map;
}

/// What is said in a remedy's place.
std::string hint(const analysis::Comparison& comparison)
{
    if (const auto trades = analysis::trade_offs(comparison); !trades.empty()) {
        const std::string_view known =
            can_advise(comparison) ? "No bias lessens wrong pixels and amounts alike; "
                                     "`--advise` measures other changes."
                                   : "No known change lessens wrong pixels and amounts alike.";
        return fmt::format("{} {}", known, remedy_sentence(comparison, trades.front()));
    }
    if (!comparison.advice.empty()) {
        return fmt::format("None of {} leaves less.",
                           counted(comparison.advice.size(), "measured change"));
    }
    const std::string beside = what_is_set_beside(comparison);
    std::string told = beside.empty() ? "" : beside + ".";
    if (!can_advise(comparison)) {
        return told;
    }
    return fmt::format("{}{}`--advise` measures what cures the errors.", told,
                       told.empty() ? "" : " ");
}

/// That another bias of the job's may be at fault, beside a remedy that leaves it; empty where it
/// is measured, or none is.
std::string other_biases_at_fault(const analysis::Comparison& comparison)
{
    const std::string beside = what_is_set_beside(comparison);
    return can_advise(comparison) && !beside.empty()
               ? fmt::format(
                     "{}, which may be at fault: `--advise` measures what is left without it.",
                     beside)
               : "";
}

/// "No scored pixel reads cascade 0, from 0.1 to 0.84 m." Empty where each is read.
std::string unread_cascades(const analysis::Comparison& comparison)
{
    const auto& maps = comparison.diagnosis->by_map;
    std::vector<std::string> unread;
    for (std::size_t i = 0; i < maps.size() && !comparison.view.slices.ends.empty(); ++i) {
        if (maps[i].counts.lit + maps[i].counts.blocked == 0) {
            const analysis::MapFacts map =
                analysis::facts_of_map(comparison.job, comparison.view, i);
            unread.push_back(fmt::format("cascade {}, from {:.4g} to {:.4g} {}", map.name,
                                         *map.begin_m, *map.end_m, length_unit(comparison)));
        }
    }
    return unread.empty() ? ""
                          : fmt::format("No scored pixel reads {}.", fmt::join(unread, "; nor "));
}

/// Whether something is wrong that has a name.
bool has_errors(const analysis::Comparison& comparison)
{
    return sum_of(analysis::named_errors(comparison).by_label) > 0;
}

/// That the first remedy, the recommended bias, is long; empty where it is short or another.
std::string warning(const analysis::Comparison& comparison,
                    const std::vector<analysis::Remedy>& remedies)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    const bool is_first = recommended && !remedies.empty() &&
                          remedies.front().keys == std::vector{recommended->rounded.key};
    return is_first ? long_bias(comparison).value_or("") : "";
}

} // namespace

std::vector<std::string> errors_as_text(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{what_is_wrong(comparison)};
    if (has_errors(comparison)) {
        append(sentences, what_it_comes_from(comparison, nullptr));
        const std::string beside = what_is_set_beside(comparison);
        append(sentences, beside.empty() ? "" : beside + ".");
    }
    return sentences;
}

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{what_is_wrong(comparison)};
    if (!has_errors(comparison)) {
        return sentences;
    }
    const auto remedies = analysis::ranked_remedies(comparison);
    const analysis::Remedy* const first = remedies.empty() ? nullptr : &remedies.front();
    append(sentences, first != nullptr ? remedy_sentence(comparison, *first) : hint(comparison));
    append(sentences, first != nullptr ? other_biases_at_fault(comparison) : "");
    append(sentences, warning(comparison, remedies));
    append(sentences, what_it_comes_from(comparison, first));
    append(sentences, can_advise(comparison) ? why_to_move_origin(comparison) : "");
    append(sentences, why_none_serves(comparison));
    append(sentences, unread_cascades(comparison));
    return sentences;
}

} // namespace gnomon::reports
