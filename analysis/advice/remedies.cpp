#include "analysis/advice/remedies.hpp"

#include "analysis/advice/lookup_cost.hpp"
#include "analysis/metrics/ratio.hpp"

#include <fmt/format.h>

#include <algorithm>
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

} // namespace

double error_amount(const Comparison& comparison)
{
    const double all = comparison.metrics.amounts.total();
    return comparison.diagnosis ? all - comparison.diagnosis->left_out().total() : all;
}

std::vector<Remedy> ranked_remedies(const Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<Remedy> remedies = comparison.advice;
    add_curves(comparison, remedies);
    remove_repeats(remedies);
    const double now = error_amount(comparison);
    std::erase_if(remedies,
                  [&](const Remedy& remedy) { return remedy.outcome.error_amount() >= now; });
    const auto left = [](const Remedy& remedy) { return remedy.outcome.error_amount(); };
    double least = now;
    for (const Remedy& remedy : remedies) {
        least = std::min(least, left(remedy));
    }
    const auto order = [&](const Remedy& remedy) {
        const bool cures_most = now - left(remedy) >= share_of_most * (now - least);
        return cures_most ? std::tuple{0, remedy.cost, left(remedy)}
                          : std::tuple{1, LookupCost{}, left(remedy)};
    };
    std::ranges::stable_sort(remedies, {}, order);
    return remedies;
}

} // namespace gnomon::analysis
