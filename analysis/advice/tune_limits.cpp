#include "analysis/advice/tune_limits.hpp"

#include <algorithm>

namespace gnomon::analysis {

namespace {

/// The largest count whose rate does not exceed the limit.
std::uint64_t allowed(double max_rate, std::uint64_t denominator)
{
    const auto whole = static_cast<double>(denominator);
    auto count = static_cast<std::uint64_t>(std::clamp(max_rate, 0.0, 1.0) * whole);
    // The product rounds, but rates are quotients: the quotient decides.
    while (count < denominator && static_cast<double>(count + 1) / whole <= max_rate) {
        ++count;
    }
    while (count > 0 && static_cast<double>(count) / whole > max_rate) {
        --count;
    }
    return count;
}

bool meets(const std::optional<double>& rate, double limit)
{
    return !rate || *rate <= limit;
}

} // namespace

bool meets(const ViewOutcome& outcome, const TuneLimits& limits)
{
    return meets(outcome.shadow_rate(), limits.max_shadow_amount_rate) &&
           meets(outcome.light_rate(), limits.max_light_amount_rate) &&
           meets(outcome.metrics.false_shadow_rate, limits.max_false_shadow_rate) &&
           meets(outcome.metrics.false_lit_rate, limits.max_false_lit_rate);
}

std::optional<BiasInterval> biases_within(const BiasCurve& curve, const TuneLimits& limits)
{
    // Each verdict is one comparison, so amounts equal counts.
    const ErrorCounts most{
        allowed(std::min(limits.max_shadow_amount_rate, limits.max_false_shadow_rate),
                curve.lit().size()),
        allowed(std::min(limits.max_light_amount_rate, limits.max_false_lit_rate),
                curve.blocked().size())};
    const auto meeting = biases_with_at_most(curve, most);
    if (!meeting || meeting->hi < 0) {
        return std::nullopt;
    }
    return BiasInterval{std::max(meeting->lo, 0.0F), meeting->hi};
}

} // namespace gnomon::analysis
