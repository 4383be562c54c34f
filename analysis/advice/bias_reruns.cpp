// The outcomes of a search's views at each bias.

#include "analysis/advice/bias_search.hpp"
#include "methods/job_method.hpp"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

scene::View BiasSearch::biased_view(const SearchedView& searched, float constant, float slope,
                                    const std::vector<float>& scales)
{
    scene::View biased = searched.view;
    biased.bias_scales = scales;
    biased.bias.constant = constant;
    biased.bias.slope = slope;
    return biased;
}

Metrics BiasSearch::measured(const SearchedView& searched, const scene::LookupLayers& own)
{
    return analysis::measure(searched.checked->truth, own,
                             methods::traits(searched.job).equal_taps());
}

CauseAmounts BiasSearch::amounts_of(std::size_t view, const scene::View& biased,
                                    const scene::LookupLayers& own) const
{
    const SearchedView& searched = views_[view];
    const scene::Bias& bias = biased.bias;
    if (searched.answers != nullptr) {
        return searched.answers->causes().causes_of(own, bias.constant, bias.slope).amounts;
    }
    if (searched.exact == nullptr) {
        return {};
    }
    LookupCauses causes{searched.exact, observe(view, biased, own)};
    return causes.causes_of(own, bias.constant, bias.slope).amounts;
}

std::vector<ErrorAmounts> BiasSearch::amounts_in(std::size_t view, float slope,
                                                 std::span<const float> biases) const
{
    const SearchedView& searched = views_[view];
    if (searched.answers != nullptr) {
        return searched.answers->measures().amounts(slope, biases);
    }
    std::vector<ErrorAmounts> amounts;
    for (const float bias : biases) {
        const scene::LookupLayers own =
            look_up(view, biased_view(searched, bias, slope, searched.view.bias_scales));
        amounts.push_back(measured(searched, own).amounts);
    }
    return amounts;
}

std::vector<ErrorAmounts> BiasSearch::pooled_amounts(float slope,
                                                     std::span<const float> biases) const
{
    std::vector<ErrorAmounts> sums(biases.size());
    for (std::size_t view = 0; view < views_.size(); ++view) {
        const auto amounts = amounts_in(view, slope, converted(view, biases));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += amounts[i];
        }
    }
    return sums;
}

Softening BiasSearch::softening_at_zero(std::size_t view, float slope) const
{
    const SearchedView& searched = views_[view];
    if (searched.answers != nullptr) {
        return searched.answers->measures().softening_at_zero(slope);
    }
    if (searched.exact == nullptr) {
        return {};
    }
    if (const auto known = softening_at_zero_.find({view, slope});
        known != softening_at_zero_.end()) {
        return known->second;
    }
    const scene::View unbiased = biased_view(searched, 0, slope, searched.view.bias_scales);
    const CauseAmounts amounts = amounts_of(view, unbiased, look_up(view, unbiased));
    const Softening found{amounts.shadow_softening, amounts.light_softening};
    softening_at_zero_.emplace(std::pair{view, slope}, found);
    return found;
}

ViewOutcome BiasSearch::measured_by_gl(std::size_t view, float constant, float slope,
                                       const std::vector<float>& scales) const
{
    const SearchedView& searched = views_[view];
    const scene::View biased = biased_view(searched, constant, slope, scales);
    const scene::LookupLayers own = look_up(view, biased);
    const CauseAmounts amounts = amounts_of(view, biased, own);
    return {constant, measured(searched, own), amounts.shadow_softening, amounts.light_softening,
            softening_at_zero(view, slope)};
}

std::vector<ViewOutcome> BiasSearch::outcomes_in(std::size_t view, float slope,
                                                 std::span<const float> biases) const
{
    std::vector<ViewOutcome> outcomes;
    if (!has_curve()) {
        for (const float bias : converted(view, biases)) {
            outcomes.push_back(measured_by_gl(view, bias, slope, views_[view].view.bias_scales));
        }
        return outcomes;
    }
    for (const MeasuredBias& at :
         views_[view].answers->measures().measure(slope, converted(view, biases))) {
        outcomes.push_back(
            {at.bias, at.metrics, at.softening.shadow, at.softening.light, at.at_zero});
    }
    return outcomes;
}

std::vector<ViewOutcome> BiasSearch::measure_as_set(float slope) const
{
    std::vector<ViewOutcome> outcomes;
    for (std::size_t view = 0; view < views_.size(); ++view) {
        outcomes.push_back(
            measured_by_gl(view, views_[view].set_constant, slope, views_[view].set_scales));
    }
    return outcomes;
}

std::vector<ViewOutcome> BiasSearch::measure(float constant, float slope) const
{
    std::vector<ViewOutcome> outcomes;
    for (std::size_t view = 0; view < views_.size(); ++view) {
        outcomes.push_back(
            measured_by_gl(view, converted(view, constant), slope, views_[view].view.bias_scales));
    }
    return outcomes;
}

} // namespace gnomon::analysis
