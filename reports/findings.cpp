#include "reports/findings.hpp"

#include "reports/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    case Cause::none:
        break;
    }
    return "";
}

/// What of the map usually reduces the errors of a cause; empty for the bias, which is not the
/// map's.
std::string_view remedy(Cause cause)
{
    switch (cause) {
    case Cause::precision:
        return "A format with more bits, or near and far closer together, are the remedy.";
    case Cause::resolution:
        return "More texels on what the camera sees, by a larger map or a tighter fit, are the "
               "remedy.";
    case Cause::coverage:
        return "Look at near, far, the frustum and culling: the light's camera misses casters.";
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

std::string what_is_wrong(const analysis::Metrics& metrics, const analysis::CauseCounts& counts)
{
    const std::uint64_t wrong = metrics.false_shadow + metrics.false_lit;
    if (metrics.pixels.scored() == 0) {
        return "No pixel is scored: nothing that the camera sees faces the light.";
    }
    if (wrong == 0) {
        return fmt::format("All {} scored pixels are right.", grouped(metrics.pixels.scored()));
    }
    const auto label = most<Label>(counts.by_label);
    const auto cause = most<Cause>(counts.by_cause);
    return fmt::format("{} of the scored pixels are wrong: {} of the errors are {}, and {} are due "
                       "to {}.",
                       percent(metrics.error_rate), share(counts.of(label), wrong), words(label),
                       share(counts.of(cause), wrong), words(cause));
}

/// "4.0 times"
std::string times(double ratio)
{
    return fmt::format("{:.2g} times", ratio);
}

/// Why no constant bias serves, where none does.
std::string why_none_serves(const analysis::BiasLimits& limits)
{
    if (!std::isfinite(limits.acne_free)) {
        return "No constant bias frees this map of acne.";
    }
    if (limits.panning_free < 0) {
        return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                           "least {:.3g}, and even 0 leaves more false light, at edges and leaks.",
                           limits.acne_free);
    }
    return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                       "least {:.3g}, and false light allows at most {:.3g}.",
                       limits.acne_free, limits.panning_free);
}

/// How the job's bias stands to what acne needs and panning allows.
std::string against_limits(float bias, const analysis::BiasBounds& bounds)
{
    const analysis::BiasLimits& limits = bounds.allowances[one_in_a_thousand];
    const float needed = limits.acne_free;
    const float allowed = limits.panning_free_beyond_zero;
    if (std::isfinite(allowed) && allowed > 0 && bias > allowed) {
        return fmt::format("The constant bias {:.3g} is {} what peter-panning allows here "
                           "({:.3g}, for at most 0.1 % of wrong pixels).",
                           bias, times(double{bias} / double{allowed}), allowed);
    }
    if (bounds.no_constant_bias_serves) {
        return why_none_serves(limits);
    }
    if (std::isfinite(needed) && needed > 0 && bias < needed) {
        return fmt::format("Against acne the constant bias should be at least {:.3g} (for at most "
                           "0.1 % of wrong pixels); it is {:.3g}.",
                           needed, bias);
    }
    return "";
}

/// The biases that are worth recommending.
constexpr analysis::BiasInterval usable_biases{0.0F, 1.0F};

/// What the best constant bias would do: the curve knows it exactly.
std::string best_bias(const analysis::Comparison& comparison, const analysis::BiasAnswers& answers)
{
    const std::uint64_t now = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    const analysis::BestBiases best = find_best_biases(answers.curve, usable_biases);
    if (best.errors.total() >= now) {
        return "No other constant bias has fewer errors.";
    }
    return fmt::format("With slope and offset as they are, bias.constant = {} has the fewest "
                       "errors: {} in place of {}.",
                       best.recommended(), grouped(best.errors.total()), grouped(now));
}

/// Of the biases that GL was run again with, the one with the fewest errors.
std::string best_rerun(const analysis::Comparison& comparison)
{
    const auto best = std::ranges::min_element(
        comparison.reruns, {}, [](const auto& rerun) { return rerun.errors.total(); });
    const std::string reruns =
        fmt::format("The driver's own filter has no bias curve, so GL was run again with {} "
                    "constant biases",
                    comparison.reruns.size());
    const std::uint64_t now = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    if (best->errors.total() >= now) {
        return fmt::format("{}: none has fewer errors.", reruns);
    }
    return fmt::format("{}: of those, bias.constant = {} has the fewest errors: {} in place of {}.",
                       reruns, best->bias, grouped(best->errors.total()), grouped(now));
}

/// Slope and normal offset are biases too, which no constant one makes up for.
std::string other_biases(const scene::Bias& bias)
{
    if (bias.slope == 0 && bias.normal_texels == 0) {
        return "";
    }
    return fmt::format("It is slope {:.3g} and normal offset {:.3g} texels as well: --advise tries "
                       "without.",
                       bias.slope, bias.normal_texels);
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
    const analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    std::vector<std::string> sentences{what_is_wrong(comparison.metrics, counts)};
    if (comparison.metrics.false_shadow + comparison.metrics.false_lit > 0) {
        const auto cause = most<Cause>(counts.by_cause);
        append(sentences, cause == Cause::bias ? other_biases(comparison.view.bias)
                                               : std::string{remedy(cause)});
    }
    return sentences;
}

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    std::vector<std::string> sentences = errors_in_words(comparison);
    if (!comparison.diagnosis ||
        comparison.metrics.false_shadow + comparison.metrics.false_lit == 0) {
        return sentences;
    }
    if (const auto& biases = comparison.diagnosis->biases) {
        append(sentences, against_limits(comparison.view.bias.constant, biases->bounds));
        append(sentences, best_bias(comparison, *biases));
    } else if (!comparison.reruns.empty()) {
        append(sentences, best_rerun(comparison));
    }
    return sentences;
}

} // namespace gnomon::reports
