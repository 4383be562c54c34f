#include "analysis/advice/remedies.hpp"

#include "analysis/advice/lookup_cost.hpp"
#include "analysis/advice/view_outcome.hpp"
#include "analysis/metrics/ratio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Of what the best remedy takes away.
constexpr double share_of_most = 0.8;
/// What another slope may leave of the error that the recommended bias leaves.
constexpr double clearly_less = 0.9;

/// What a change of biases leaves: the map stays as it is.
Remedy bias_remedy(const Comparison& comparison, std::vector<std::string> keys,
                   const Outcome& outcome, MeasuredBy measured_by)
{
    return {std::move(keys), outcome,
            ratio(outcome.errors.total(), comparison.metrics.pixels.scored()),
            lookup_cost(comparison.job), measured_by};
}

Remedy recommended_remedy(const Comparison& comparison, std::vector<std::string> keys,
                          const Recommendation& recommended, MeasuredBy measured_by)
{
    keys.push_back(recommended.pasted.key);
    Remedy remedy =
        bias_remedy(comparison, std::move(keys), recommended.pasted_outcome, measured_by);
    remedy.bias = recommended.pasted_length;
    if (remedy.keys.size() == 1 &&
        std::abs(recommended.pasted.bias) < std::abs(comparison.view.bias.constant)) {
        remedy.bias_change = BiasChange::mends;
    }
    return remedy;
}

/// The slope that leaves the least error with its recommended bias, of equal ones that with the
/// shortest; nullptr if none leaves clearly less than the job's own: it is one more key to set.
/// Slopes are known of the job's own view alone.
const SlopeAnswer* best_slope(const Comparison& comparison)
{
    const Diagnosis& diagnosis = *comparison.diagnosis;
    if (!diagnosis.biases || comparison.advice_views.views.size() > 1) {
        return nullptr;
    }
    const auto order = [](const Recommendation& found) {
        return std::tuple{found.pasted_outcome.error_amount(), found.pasted_length.metres};
    };
    const auto& own = diagnosis.curve.recommended;
    const SlopeAnswer* best = nullptr;
    for (const SlopeAnswer& answer : diagnosis.biases->slopes) {
        const bool leaves_less = answer.recommended && answer.slope != comparison.view.bias.slope &&
                                 (!own || answer.recommended->pasted_outcome.error_amount() <
                                              clearly_less * own->pasted_outcome.error_amount());
        if (leaves_less &&
            (best == nullptr || order(*answer.recommended) < order(*best->recommended))) {
            best = &answer;
        }
    }
    return best;
}

void add_curves(const Comparison& comparison, std::vector<Remedy>& remedies)
{
    const Diagnosis& diagnosis = *comparison.diagnosis;
    if (diagnosis.curve.recommended) {
        remedies.push_back(
            recommended_remedy(comparison, {}, *diagnosis.curve.recommended, MeasuredBy::curve));
        if (diagnosis.curve.recommended->views == 1) {
            remedies.back().left = diagnosis.left_by_recommended;
        }
    }
    if (const SlopeAnswer* slope = best_slope(comparison)) {
        remedies.push_back(recommended_remedy(comparison,
                                              {fmt::format("bias.slope = {}", slope->slope)},
                                              *slope->recommended, MeasuredBy::slope_curve));
    }
}

/// Changes that say the same: what GL measured goes before what a curve knows.
void remove_repeats(std::vector<Remedy>& remedies)
{
    std::vector<Remedy> once;
    for (Remedy& remedy : remedies) {
        if (std::ranges::none_of(once,
                                 [&](const Remedy& known) { return known.keys == remedy.keys; })) {
            once.push_back(std::move(remedy));
        }
    }
    remedies = std::move(once);
}

/// Whether it leaves at least half of what is truly in shadow dark: in the job's own view, and in
/// all views together.
bool keeps_shadows(const Comparison& comparison, const Remedy& remedy)
{
    constexpr double half = 0.5;
    const auto keeps = [](double light, std::uint64_t blocked) {
        return light <= half * static_cast<double>(blocked);
    };
    const std::uint64_t blocked = comparison.metrics.pixels.of(scene::PixelClass::blocked);
    const Outcome& own = remedy.outcome;
    if (!keeps(own.amounts.light, blocked) ||
        !keeps(static_cast<double>(own.errors.false_lit), blocked)) {
        return false;
    }
    if (remedy.views.empty()) {
        return true;
    }
    const Metrics all = pooled(remedy.views).metrics;
    return keeps(all.amounts.light, all.pixels.of(scene::PixelClass::blocked));
}

/// All changes that leave less error and keep the shadows, in their order.
std::vector<Remedy> sorted_remedies(const Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<Remedy> remedies = comparison.advice;
    add_curves(comparison, remedies);
    remove_repeats(remedies);
    const double now = error_amount(comparison);
    std::erase_if(remedies, [&](const Remedy& remedy) {
        return remedy.outcome.error_amount() >= now || !keeps_shadows(comparison, remedy);
    });
    const auto left = [](const Remedy& remedy) { return remedy.outcome.error_amount(); };
    double least = now;
    for (const Remedy& remedy : remedies) {
        least = std::min(least, left(remedy));
    }
    const auto order = [&](const Remedy& remedy) {
        const bool worsens = changes_of(comparison, remedy).worsens();
        const bool cures_most = now - left(remedy) >= share_of_most * (now - least);
        const bool needs_slope = remedy.measured_by == MeasuredBy::slope_curve;
        return cures_most
                   ? std::tuple{worsens,     0,           remedy.cost, remedy.bias_change,
                                needs_slope, left(remedy)}
                   : std::tuple{worsens, 1, LookupCost{}, BiasChange::other, false, left(remedy)};
    };
    std::ranges::stable_sort(remedies, {}, order);
    return remedies;
}

} // namespace

double error_amount(const Comparison& comparison)
{
    const double all = comparison.metrics.amounts.total();
    return comparison.diagnosis ? all - comparison.diagnosis->left_out().total() : all;
}

ErrorChanges changes_of(const Comparison& comparison, const Remedy& remedy)
{
    const auto change = [](auto before, auto after) {
        return after < before ? Change::less : after == before ? Change::as_before : Change::more;
    };
    const Metrics& now = comparison.metrics;
    return {change(now.false_shadow + now.false_lit, remedy.outcome.errors.total()),
            change(now.amounts.total(), remedy.outcome.amounts.total())};
}

std::vector<Remedy> ranked_remedies(const Comparison& comparison)
{
    std::vector<Remedy> remedies = sorted_remedies(comparison);
    if (!remedies.empty() && changes_of(comparison, remedies.front()).worsens()) {
        return {};
    }
    return remedies;
}

std::vector<Remedy> trade_offs(const Comparison& comparison)
{
    std::vector<Remedy> remedies = sorted_remedies(comparison);
    if (!remedies.empty() && !changes_of(comparison, remedies.front()).worsens()) {
        return {};
    }
    std::ranges::stable_sort(remedies, {},
                             [](const Remedy& remedy) { return remedy.outcome.error_amount(); });
    return remedies;
}

} // namespace gnomon::analysis
