#include "reports/findings.hpp"

#include "reports/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::Cause;
using analysis::Label;

constexpr std::size_t one_in_a_thousand = 1; // of the allowances

std::string_view words(Label label)
{
    switch (label) {
    case Label::acne:
        return "acne";
    case Label::peter_panning:
        return "peter-panning";
    case Label::leak:
        return "leaks";
    case Label::edge:
        return "ragged or displaced shadow edges";
    case Label::overshadow:
        return "shadows where there are none";
    case Label::bleed:
        return "light that the method alone lets through";
    case Label::none:
        break;
    }
    return "";
}

std::string_view words(Cause cause)
{
    switch (cause) {
    case Cause::bias:
        return "the bias";
    case Cause::precision:
        return "the depth format's precision";
    case Cause::resolution:
        return "the map's resolution";
    case Cause::coverage:
        return "what the map does not cover";
    case Cause::filter:
        return "the filter's footprint";
    case Cause::none:
        break;
    }
    return "";
}

/// What of the map to look at for a cause; empty for the bias, which is not the map's.
std::string_view to_try(Cause cause)
{
    switch (cause) {
    case Cause::precision:
        return "For precision, try a format with more bits, or near and far closer together";
    case Cause::resolution:
        return "For resolution, try more texels on what the camera sees: a larger map or a tighter "
               "fit";
    case Cause::coverage:
        return "For coverage, look at near, far, the frustum and culling: the light's camera "
               "misses casters";
    case Cause::filter:
        return "For the filter, try a smaller kernel, or more texels under it";
    case Cause::bias:
    case Cause::none:
        break;
    }
    return "";
}

/// The value with the most wrong pixels.
template <typename Value, typename Counts>
Value most(const Counts& counts)
{
    return static_cast<Value>(std::ranges::max_element(counts) - counts.begin());
}

/// "82 %": a share as people say it.
std::string share(std::uint64_t part, std::uint64_t whole)
{
    const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    if (part != whole && percent > 99) {
        return "over 99 %";
    }
    return percent < 1 ? "under 1 %" : fmt::format("{:.0f} %", percent);
}

/// "82 %": the same of amounts.
std::string share(double part, double whole)
{
    const double percent = 100.0 * part / whole;
    return percent < 1 ? "under 1 %" : fmt::format("{:.0f} %", percent);
}

/// What most of the amount of error is, beside what a kernel softens on purpose; empty where there
/// is none.
std::string most_of_amount(const analysis::Metrics& metrics, const analysis::CauseAmounts& amounts)
{
    const double all = metrics.amounts.total();
    if (all == 0) {
        return "";
    }
    const double softening = amounts.softening();
    analysis::CauseAmounts others = amounts;
    others.by_label[static_cast<std::size_t>(Label::edge)] -= softening;
    const auto label = most<Label>(others.by_label);
    std::vector<std::string> parts;
    if (others.of(label) > 0) {
        parts.push_back(fmt::format("{} is {}", share(others.of(label), all), words(label)));
    }
    if (softening > 0) {
        parts.push_back(
            fmt::format("{} is borders that the kernel softens on purpose", share(softening, all)));
    }
    return parts.empty() ? "" : fmt::format(" Of the amount, {}.", fmt::join(parts, ", and "));
}

/// No verdict is on the wrong side of one half, and yet they are not right.
std::string none_is_wrong_but(const analysis::Metrics& metrics,
                              const analysis::CauseAmounts& amounts)
{
    return fmt::format("No scored pixel is wrong by more than one half, yet verdicts are off by {} "
                       "on average: {} of {} pixels are partly wrong, by {} pixels of false shadow "
                       "and {} of false light in all.{}",
                       percent(metrics.mean_abs_error), grouped(metrics.amounts.partial),
                       grouped(metrics.pixels.scored()), grouped_amount(metrics.amounts.shadow),
                       grouped_amount(metrics.amounts.light), most_of_amount(metrics, amounts));
}

/// What verdicts that are fractions add to the counts; empty where none are.
std::string by_amount(const analysis::Metrics& metrics, const analysis::CauseAmounts& amounts)
{
    return has_fractions(metrics)
               ? fmt::format(" By amount verdicts are off by {} on average.{}",
                             percent(metrics.mean_abs_error), most_of_amount(metrics, amounts))
               : "";
}

std::string what_is_wrong(const analysis::Metrics& metrics, const analysis::CauseLayers& causes)
{
    const analysis::CauseCounts& counts = causes.counts;
    const std::uint64_t wrong = metrics.false_shadow + metrics.false_lit;
    if (metrics.pixels.scored() == 0) {
        return "No pixel is scored: nothing that the camera sees faces the light.";
    }
    if (wrong == 0) {
        return has_fractions(metrics) ? none_is_wrong_but(metrics, causes.amounts)
                                      : fmt::format("All {} scored pixels are right.",
                                                    grouped(metrics.pixels.scored()));
    }
    const auto label = most<Label>(counts.by_label);
    const auto cause = most<Cause>(counts.by_cause);
    return fmt::format("{} of the scored pixels are wrong: {} of the errors are {}, and {} are due "
                       "to {}.{}",
                       percent(metrics.error_rate), share(counts.of(label), wrong), words(label),
                       share(counts.of(cause), wrong), words(cause),
                       by_amount(metrics, causes.amounts));
}

/// "4.0 times"
std::string times(double ratio)
{
    return fmt::format("{:.2g} times", ratio);
}

/// Why no constant bias serves, where none does.
std::string why_none_serves(const analysis::BiasLimits& limits)
{
    if (!std::isfinite(limits.acne_free_count)) {
        return "No constant bias frees this map of acne.";
    }
    if (limits.panning_free < 0) {
        return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                           "least {:.3g}, and even 0 leaves more false light.",
                           limits.acne_free_count);
    }
    return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                       "least {:.3g}, and false light allows at most {:.3g}.",
                       limits.acne_free_count, limits.panning_free);
}

/// How the job's bias stands to what acne needs and panning allows.
std::string against_limits(float bias, const analysis::BiasBounds& bounds)
{
    const analysis::BiasLimits& limits = bounds.allowances[one_in_a_thousand];
    if (bounds.no_constant_bias_serves) {
        return why_none_serves(limits);
    }
    const float needed = limits.acne_free;
    // Edges and leaks alone may be too many, and no bias brought those about.
    const bool counts_all = limits.panning_free > 0;
    const float allowed = counts_all ? limits.panning_free : limits.panning_free_beyond_zero;
    if (std::isfinite(allowed) && allowed > 0 && bias > allowed) {
        return fmt::format("The constant bias {:.3g} is {} what peter-panning allows here "
                           "({:.3g}, for at most 0.1 % of wrong pixels{}).",
                           bias, times(double{bias} / double{allowed}), allowed,
                           counts_all ? "" : " beside those that are false lit without bias");
    }
    if (std::isfinite(needed) && needed > 0 && bias < needed) {
        return fmt::format("Against acne the constant bias should be at least {:.3g} (for at most "
                           "0.1 % of the pixels, by amount); it is {:.3g}.",
                           needed, bias);
    }
    return "";
}

/// The biases that are worth recommending.
constexpr analysis::BiasInterval usable_biases{0.0F, 1.0F};

/// The change with the least errors, of those that were measured.
struct Change {
    std::string beginning; ///< of its sentence: what was measured
    std::string keys;
    double errors = 0; ///< pixels; where verdicts are fractions, the amount of error
    double now = 0;    ///< the job's own, of the same kind
    /// What is left out of that amount, or is not; empty: they are counts.
    std::string_view amount = {};
};

constexpr std::string_view with_softening = "softened borders included";
constexpr std::string_view without_softening = "without softened borders";

/// What the best constant bias would do: the curve knows it exactly.
Change best_bias(const analysis::BiasAnswers& answers, const analysis::Metrics& now)
{
    const analysis::BestBiases best = find_best_biases(answers.curve, usable_biases);
    return {"With slope and offset as they are",
            fmt::format("bias.constant = {}", best.recommended()),
            static_cast<double>(best.errors.total()),
            static_cast<double>(now.false_shadow + now.false_lit)};
}

/// The same where verdicts are fractions: of the curve's points.
Change least_amount(const std::vector<analysis::CurveSample>& points, const analysis::Metrics& now)
{
    const auto amount = [](const analysis::CurveSample& point) {
        const bool is_usable = point.bias >= usable_biases.lo && point.bias <= usable_biases.hi;
        return is_usable ? point.counts.shadow_amount + point.counts.light_amount
                         : std::numeric_limits<double>::infinity();
    };
    const auto best = std::ranges::min_element(points, {}, amount);
    return {"With slope and offset as they are", fmt::format("bias.constant = {}", best->bias),
            amount(*best), now.amounts.total(), with_softening};
}

/// Of the biases that GL was run again with.
Change best_rerun(const std::vector<analysis::BiasRerun>& reruns, const analysis::Metrics& now)
{
    const auto best = std::ranges::min_element(
        reruns, {}, [](const auto& rerun) { return rerun.amounts.total(); });
    return {fmt::format("The driver's own filter has no bias curve, so GL was run again with {} "
                        "constant biases: of those",
                        reruns.size()),
            fmt::format("bias.constant = {}", best->bias), best->amounts.total(),
            now.amounts.total(), with_softening};
}

Change best_advice(const analysis::Comparison& comparison, const analysis::Diagnosis& diagnosis)
{
    const std::string beginning =
        fmt::format("Of {} measured", counted(comparison.advice.size(), "change"));
    const auto keys = [](const analysis::Advice& advice) {
        return fmt::format("{}", fmt::join(advice.keys, ", "));
    };
    const analysis::Metrics& now = comparison.metrics;
    if (has_fractions(now)) {
        const auto best =
            std::ranges::min_element(comparison.advice, {}, &analysis::Advice::error_amount);
        return {beginning, keys(*best), best->error_amount(),
                now.amounts.total() - diagnosis.causes.amounts.softening(), without_softening};
    }
    const auto best = std::ranges::min_element(
        comparison.advice, {}, [](const auto& change) { return change.errors.total(); });
    return {beginning, keys(*best), static_cast<double>(best->errors.total()),
            static_cast<double>(now.false_shadow + now.false_lit)};
}

/// The best change that is known; nothing where a diagnosis has no such answers.
std::optional<Change> best_change(const analysis::Comparison& comparison,
                                  const analysis::Diagnosis& diagnosis)
{
    const analysis::Metrics& now = comparison.metrics;
    if (!comparison.advice.empty()) {
        return best_advice(comparison, diagnosis);
    }
    if (diagnosis.biases) {
        return has_fractions(now) && !diagnosis.curve.points.empty()
                   ? least_amount(diagnosis.curve.points, now)
                   : best_bias(*diagnosis.biases, now);
    }
    return comparison.reruns.empty() ? std::nullopt
                                     : std::optional{best_rerun(comparison.reruns, now)};
}

std::string in_words(const Change& change)
{
    const bool is_better = change.errors < change.now;
    if (!change.amount.empty()) {
        return is_better
                   ? fmt::format("{}, {} is the least wrong by amount: {} px in place of {}, {}.",
                                 change.beginning, change.keys, grouped_amount(change.errors),
                                 grouped_amount(change.now), change.amount)
                   : fmt::format("{}, none is less wrong by amount.", change.beginning);
    }
    return is_better
               ? fmt::format("{}, {} has the fewest errors: {} in place of {}.", change.beginning,
                             change.keys, grouped(static_cast<std::uint64_t>(change.errors)),
                             grouped(static_cast<std::uint64_t>(change.now)))
               : fmt::format("{}, none has fewer errors.", change.beginning);
}

/// Slope and normal offset are biases too, which no constant one makes up for.
std::string other_biases(const scene::Bias& bias)
{
    std::vector<std::string> others;
    if (bias.slope != 0) {
        others.push_back(fmt::format("a slope bias of {:.3g}", bias.slope));
    }
    if (bias.normal_texels != 0) {
        others.push_back(fmt::format("a normal offset of {:.3g} texels", bias.normal_texels));
    }
    return others.empty() ? "" : fmt::format("There is {} as well", fmt::join(others, " and "));
}

/// What to look at for the main cause, without its full stop.
std::string what_to_try(const scene::Bias& bias, const analysis::CauseCounts& counts)
{
    const auto cause = most<Cause>(counts.by_cause);
    return cause == Cause::bias ? other_biases(bias) : std::string{to_try(cause)};
}

void append(std::vector<std::string>& sentences, std::string sentence)
{
    if (!sentence.empty()) {
        sentences.push_back(std::move(sentence));
    }
}

} // namespace

std::vector<std::string> errors_in_words(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    const analysis::CauseLayers& causes = comparison.diagnosis->causes;
    std::vector<std::string> sentences{what_is_wrong(comparison.metrics, causes)};
    if (comparison.metrics.false_shadow + comparison.metrics.false_lit > 0) {
        const std::string hint = what_to_try(comparison.view.bias, causes.counts);
        append(sentences, hint.empty() ? hint : hint + ".");
    }
    return sentences;
}

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    const std::uint64_t now = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    if (!comparison.diagnosis || (now == 0 && !has_fractions(comparison.metrics))) {
        return errors_in_words(comparison);
    }
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    const analysis::CauseCounts& counts = diagnosis.causes.counts;
    std::vector<std::string> sentences{what_is_wrong(comparison.metrics, diagnosis.causes)};
    if (diagnosis.biases) {
        append(sentences, against_limits(comparison.view.bias.constant, diagnosis.biases->bounds));
    }
    const auto change = best_change(comparison, diagnosis);
    const bool helps = change && change->errors < change->now;
    if (change && (helps || sentences.size() < 2)) {
        append(sentences, in_words(*change));
    }
    if (now == 0) {
        return sentences;
    }
    const std::string hint = what_to_try(comparison.view.bias, counts);
    if (sentences.size() < 3 && comparison.advice.empty() && !hint.empty()) {
        append(sentences,
               fmt::format("{}{}", hint, comparison.evaluation ? "." : "; --advise measures it."));
    }
    return sentences;
}

} // namespace gnomon::reports
