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

/// What usually reduces the errors of a cause.
std::string_view remedy(Cause cause)
{
    switch (cause) {
    case Cause::bias:
        return "Change the bias first.";
    case Cause::precision:
        return "A format with more bits, or near and far closer together, are the remedy.";
    case Cause::resolution:
        return "More texels on what the camera sees, by a larger map or a tighter fit, are the "
               "remedy.";
    case Cause::coverage:
        return "Look at near, far, the frustum and culling: the light's camera misses casters.";
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

/// How the job's bias stands to what acne needs and panning allows.
std::string against_limits(float bias, const analysis::BiasBounds& bounds)
{
    const analysis::BiasLimits& limits = bounds.allowances[one_in_a_thousand];
    const float needed = limits.acne_free;
    const float allowed = limits.panning_free;
    if (bounds.no_constant_bias_serves) {
        if (!std::isfinite(allowed) || allowed < 0) {
            return "No constant bias serves this map: with none at all, more than 0.1 % of the "
                   "scored pixels are lit that should not be.";
        }
        return fmt::format("No constant bias serves this scene: for at most 0.1 % of wrong pixels, "
                           "acne needs at least {:.3g} and peter-panning allows at most {:.3g}.",
                           needed, allowed);
    }
    if (std::isfinite(allowed) && allowed > 0 && bias > allowed) {
        return fmt::format("The constant bias {:.3g} is {} what peter-panning allows here "
                           "({:.3g}, for at most 0.1 % of wrong pixels).",
                           bias, times(double{bias} / double{allowed}), allowed);
    }
    if (std::isfinite(needed) && needed > 0 && bias < needed) {
        return fmt::format("Against acne the constant bias should be at least {:.3g} (for at most "
                           "0.1 % of wrong pixels); it is {:.3g}.",
                           needed, bias);
    }
    return "";
}

/// What the best constant bias would do: the curve knows it exactly.
std::string best_bias(const analysis::Comparison& comparison, const analysis::BiasAnswers& answers)
{
    const std::uint64_t now = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    const std::uint64_t best = answers.best.errors.total();
    if (now == 0) {
        return "";
    }
    if (best == now) {
        return "No other constant bias has fewer errors.";
    }
    const float bias = answers.best.interval.middle();
    return fmt::format("With slope and offset as they are, bias.constant = {:.4g} has the fewest "
                       "errors: {} in place of {}.",
                       bias, grouped(answers.curve.at(bias).total()), grouped(now));
}

void append(std::vector<std::string>& sentences, std::string sentence)
{
    if (!sentence.empty()) {
        sentences.push_back(std::move(sentence));
    }
}

} // namespace

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    std::vector<std::string> sentences{what_is_wrong(comparison.metrics, diagnosis.causes.counts)};
    if (comparison.metrics.false_shadow + comparison.metrics.false_lit == 0) {
        return sentences;
    }
    const auto cause = most<Cause>(diagnosis.causes.counts.by_cause);
    if (diagnosis.biases) {
        append(sentences, against_limits(comparison.view.bias.constant, diagnosis.biases->bounds));
    }
    if (cause != Cause::bias) {
        append(sentences, std::string{remedy(cause)});
    }
    if (diagnosis.biases) {
        append(sentences, best_bias(comparison, *diagnosis.biases));
    } else if (cause == Cause::bias) {
        append(sentences, std::string{remedy(cause)});
    }
    return sentences;
}

} // namespace gnomon::reports
