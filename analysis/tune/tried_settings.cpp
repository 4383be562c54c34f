#include "analysis/tune/tried_settings.hpp"

#include <algorithm>
#include <tuple>

namespace gnomon::analysis {

namespace {

double error_of(const TunedSetting& setting)
{
    return mean_amount_rate(setting.bias.outcomes.front());
}

} // namespace

bool TriedSettings::is_less_wrong(std::size_t a, std::size_t b) const
{
    return error_of(all_[a]) < error_of(all_[b]);
}

std::size_t TriedSettings::least_wrong(std::size_t first) const
{
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto least =
        std::min_element(begin, all_.end(), [](const TunedSetting& a, const TunedSetting& b) {
            return std::tuple{error_of(a), a.cost} < std::tuple{error_of(b), b.cost};
        });
    return static_cast<std::size_t>(least - all_.begin());
}

TuneLimits TriedSettings::limits() const
{
    if (all_.empty()) {
        return absolute_limits();
    }
    return limits_of(goal_, {&all_[least_wrong()].bias.outcomes.front(), 1});
}

TuneLimits TriedSettings::absolute_limits() const
{
    return {goal_.max_shadow_amount_rate.value_or(1), goal_.max_light_amount_rate.value_or(1),
            goal_.max_false_shadow_rate, goal_.max_false_lit_rate, goal_.max_resolution_texels};
}

std::optional<std::size_t> TriedSettings::cheapest_meeting(const TuneLimits& limits) const
{
    std::optional<std::size_t> best;
    const auto as_meeting = [&](std::size_t index) {
        TunedSetting setting = all_[index];
        setting.bias.meets_limits = true;
        return setting;
    };
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (meets_in_its_views(all_[i], limits) &&
            (!best || is_better(as_meeting(i), as_meeting(*best)))) {
            best = i;
        }
    }
    return best;
}

bool meets_in_its_views(const TunedSetting& setting, const TuneLimits& limits)
{
    return std::ranges::all_of(setting.bias.outcomes,
                               [&](const ViewOutcome& outcome) { return meets(outcome, limits); });
}

} // namespace gnomon::analysis
