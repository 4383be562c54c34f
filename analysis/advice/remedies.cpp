#include "analysis/advice/remedies.hpp"

#include "analysis/comparison/remedy.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/pixels/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Share of what the best remedy removes.
constexpr double share_of_most = 0.8;
/// Share of the error that a change must remove to be listed, or more than another.
constexpr double share_seen = 0.005;
/// Share of the recommended bias's error that another slope may leave at most.
constexpr double clearly_less = 0.9;

/// A change of biases, which keeps the map.
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
    keys.push_back(recommended.rounded.key);
    Remedy remedy =
        bias_remedy(comparison, std::move(keys), recommended.rounded_outcome, measured_by);
    remedy.bias = recommended.rounded_length;
    if (remedy.keys.size() == 1 &&
        std::abs(recommended.rounded.bias) < std::abs(comparison.view.bias.constant)) {
        remedy.bias_change = BiasChange::mends;
    }
    return remedy;
}

/// The slope with the least error at its recommended bias; among equals, the one with the shortest
/// bias. Null if none is clearly better than the job's own, since it is one more key to set. Only
/// the job's own view has slopes.
const SlopeAnswer* best_slope(const Comparison& comparison)
{
    const Diagnosis& diagnosis = *comparison.diagnosis;
    if (!diagnosis.biases || comparison.advice_views.views.size() > 1) {
        return nullptr;
    }
    const auto order = [](const Recommendation& found) {
        return std::tuple{found.rounded_outcome.error_amount(), found.rounded_length.metres};
    };
    const auto& own = diagnosis.curve.recommended;
    const SlopeAnswer* best = nullptr;
    for (const SlopeAnswer& answer : diagnosis.biases->slopes) {
        const bool leaves_less = answer.recommended && answer.slope != comparison.view.bias.slope &&
                                 (!own || answer.recommended->rounded_outcome.error_amount() <
                                              clearly_less * own->rounded_outcome.error_amount());
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

/// Removes duplicate changes; measurements take precedence over curves.
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

bool keeps_half(const ErrorAmounts& amounts, std::uint64_t false_lit, std::uint64_t blocked)
{
    const double half = 0.5 * static_cast<double>(blocked);
    return amounts.light <= half && static_cast<double>(false_lit) <= half;
}

/// Checks the job's own view and all views together.
bool keeps_shadows_in_views(const Comparison& comparison, const Remedy& remedy)
{
    if (!keeps_shadows(comparison, remedy.outcome)) {
        return false;
    }
    if (remedy.views.empty()) {
        return true;
    }
    const Metrics all = pooled(remedy.views).metrics;
    return keeps_half(all.amounts, 0, all.pixels.of(scene::PixelClass::blocked));
}

/// Whether another remedy leaves about as little with a subset of the keys.
bool adds_nothing(const Remedy& remedy, const std::vector<Remedy>& others, double visible)
{
    return std::ranges::any_of(others, [&](const Remedy& other) {
        const bool has_fewer = other.keys.size() < remedy.keys.size() &&
                               std::ranges::all_of(other.keys, [&](const std::string& key) {
                                   return std::ranges::find(remedy.keys, key) != remedy.keys.end();
                               });
        return has_fewer && other.outcome.error_amount() <= remedy.outcome.error_amount() + visible;
    });
}

/// All changes that reduce the error and keep the shadows, sorted.
std::vector<Remedy> sorted_remedies(const Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<Remedy> remedies = comparison.advice;
    add_curves(comparison, remedies);
    remove_repeats(remedies);
    const double now = error_amount(comparison);
    const double visible = share_seen * now;
    std::erase_if(remedies, [&](const Remedy& remedy) {
        return remedy.outcome.error_amount() > now - visible ||
               remedy.outcome.error_amount() >= now || !keeps_shadows_in_views(comparison, remedy);
    });
    std::erase_if(remedies, [&, others = remedies](const Remedy& remedy) {
        return adds_nothing(remedy, others, visible);
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

bool keeps_shadows(const Comparison& comparison, const Outcome& outcome)
{
    return keeps_half(outcome.amounts, outcome.errors.false_lit,
                      comparison.metrics.pixels.of(scene::PixelClass::blocked));
}

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
