#include "analysis/comparison/view_outcome.hpp"

#include "analysis/pixels/statistics.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::PixelClass;

std::optional<double> ViewOutcome::error_rate() const
{
    return ratio(error_amount(), metrics.pixels.scored());
}

std::optional<double> ViewOutcome::shadow_rate() const
{
    return ratio(metrics.amounts.shadow - left_out().shadow, metrics.pixels.of(PixelClass::lit));
}

std::optional<double> ViewOutcome::light_rate() const
{
    return ratio(metrics.amounts.light - left_out().light, metrics.pixels.of(PixelClass::blocked));
}

ViewOutcome pooled(std::span<const ViewOutcome> outcomes)
{
    ViewOutcome sum = outcomes.front();
    for (const ViewOutcome& outcome : outcomes.subspan(1)) {
        sum.metrics += outcome.metrics;
        sum.shadow_softening += outcome.shadow_softening;
        sum.light_softening += outcome.light_softening;
        sum.most_left_out += outcome.most_left_out;
    }
    return sum;
}

std::size_t worst_view(std::span<const ViewOutcome> outcomes)
{
    const auto rate = [](const ViewOutcome& view) { return view.error_rate().value_or(0); };
    return static_cast<std::size_t>(std::ranges::max_element(outcomes, {}, rate) -
                                    outcomes.begin());
}

} // namespace gnomon::analysis
