#include "reference_rt/critical_bias.hpp"

#include "scene/infinity.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace gnomon::reference_rt {

namespace {

using scene::infinity;

/// What a texel's ray meets; it stays where it is, as the hit refers to its ray and facet.
struct TapHit {
    CameraRay ray;
    Facet facet;
    Receiver hit;
};

Fraction number(double x)
{
    return {Dyadic{x}, Dyadic{1}};
}

/// As `first_hits` found it.
Bounded known_depth(const scene::ExactTap& tap)
{
    return {tap.depth, tap.triangle == scene::no_triangle ? 0 : tap.depth_error};
}

/// What a bias must make up for: r − d, or reversed d − r.
template <std::size_t n>
Bounded bounded_excess(const Bounded& receiver, const std::array<scene::ExactTap, n>& taps,
                       const std::array<double, n>& weights, bool is_reversed)
{
    Bounded excess = receiver;
    for (std::size_t i = 0; i < n; ++i) {
        const Bounded depth = known_depth(taps[i]);
        excess = excess - (weights[i] == 1 ? depth : Bounded{weights[i], 0} * depth);
    }
    return is_reversed ? Bounded{-excess.value, excess.error} : excess;
}
/// The same in twice double's precision.
template <std::size_t n>
Wide sharp_excess(const DepthTerm& receiver, const std::array<DepthTerm, n>& taps,
                  const std::array<double, n>& weights, bool is_reversed)
{
    Wide excess = receiver.sharp();
    for (std::size_t i = 0; i < n; ++i) {
        const Wide depth = taps[i].sharp();
        excess = excess - (weights[i] == 1 ? depth : WideField::number(weights[i]) * depth);
    }
    return is_reversed ? WideField::number(0) - excess : excess;
}

/// The bias where the whole interval asks for the same.
std::optional<float> certain_bias(const Bounded& excess)
{
    const float bias = smallest_bias_from(excess.lower());
    return bias == smallest_bias_from(excess.upper()) ? std::optional{bias} : std::nullopt;
}

/// The bias where the sum of both parts, within their error, leaves no doubt.
std::optional<float> certain_bias(const Wide& excess)
{
    const Bounded rounded = excess.rounded();
    const float bias = smallest_bias_from(rounded.lower());
    const float next = smallest_bias_from(rounded.upper());
    if (bias == next) {
        return bias;
    }
    if (!(rounded.error <= 0x1p-50 * std::abs(rounded.value))) {
        return std::nullopt;
    }
    // Between two floats there are many doubles: `bias` is the only one within the error.
    const Bounded beyond = (excess - WideField::number(bias)).rounded();
    if (beyond.is_certainly_positive()) {
        return next;
    }
    return beyond.is_certainly_negative() ? std::optional{bias} : std::nullopt;
}

/// The exact difference that a bias must make up for.
Fraction exact_excess(const DepthTerm& receiver, std::span<const DepthTerm> taps,
                      std::span<const double> weights, bool is_reversed)
{
    Fraction excess = receiver.exact();
    for (std::size_t i = 0; i < taps.size(); ++i) {
        Fraction tap = taps[i].exact();
        tap.numerator = Dyadic{weights[i]} * tap.numerator;
        excess = excess - tap;
    }
    if (is_reversed) {
        excess.numerator = Dyadic{} - excess.numerator;
    }
    return excess;
}

float smallest_bias_of(const Fraction& excess)
{
    if (excess.denominator.sign() == 0) {
        return infinity;
    }
    const double x = excess.value();
    const double reach = 0x1p-51 * std::abs(x);
    const float bias = smallest_bias_from(x - reach);
    const float next = smallest_bias_from(x + reach);
    // Between two floats there are many doubles: `bias` is the only one within the error of x.
    return bias == next || (excess - number(static_cast<double>(bias))).sign() <= 0 ? bias : next;
}

} // namespace

float smallest_bias_from(double x)
{
    constexpr double smallest_normal{std::numeric_limits<float>::min()};
    if (x > -smallest_normal && x <= smallest_normal) {
        return x > 0 ? std::numeric_limits<float>::min() : 0.0F;
    }
    const auto nearest = static_cast<float>(x);
    return static_cast<double>(nearest) < x ? std::nextafter(nearest, infinity) : nearest;
}

Wide DepthTerm::sharp() const
{
    if (hit_ == nullptr) {
        return {bounded_.value, 0, bounded_.error};
    }
    return hit_->is_tame() ? depth_->widely_at(*hit_)
                           : Wide{0, 0, std::numeric_limits<double>::infinity()};
}

Fraction DepthTerm::exact() const
{
    return hit_ == nullptr ? number(bounded_.value) : depth_->exactly_at(*hit_);
}

DepthTerm DepthTerm::clamped() const
{
    const Bounded rest = Bounded{1, 0} - bounded_;
    if (bounded_.is_certainly_positive() && rest.is_certainly_positive()) {
        return *this;
    }
    const Fraction depth = exact();
    if (depth.sign() < 0) {
        return DepthTerm{0};
    }
    return (depth - number(1)).sign() > 0 ? DepthTerm{1} : *this;
}

template <std::size_t n>
float CriticalBias::find(const DepthTerm& receiver, const std::array<scene::ExactTap, n>& taps,
                         const std::array<double, n>& weights) const
{
    const auto bias =
        certain_bias(bounded_excess(receiver.bounded(), taps, weights, depth_.is_reversed()));
    return bias ? *bias : find_exactly(receiver, taps, weights);
}

template <std::size_t n>
float CriticalBias::find_exactly(const DepthTerm& receiver,
                                 const std::array<scene::ExactTap, n>& taps,
                                 const std::array<double, n>& weights) const
{
    std::array<TapHit, n> hits;
    std::array<DepthTerm, n> terms;
    SignCounts counts;
    for (std::size_t i = 0; i < n; ++i) {
        if (taps[i].triangle == scene::no_triangle) {
            terms[i] = DepthTerm{taps[i].depth};
        } else {
            TapHit& tap = hits[i];
            tap.ray = CameraRay{rays_.ray(taps[i].texel)};
            tap.facet = Facet{taps[i].triangle, corners_of(triangles_, taps[i].triangle)};
            tap.hit = Receiver{tap.facet, tap.ray, counts};
            terms[i] = DepthTerm{depth_, tap.hit, known_depth(taps[i])};
        }
    }
    const bool is_reversed = depth_.is_reversed();
    if (const auto bias = certain_bias(sharp_excess(receiver, terms, weights, is_reversed))) {
        return *bias;
    }
    return smallest_bias_of(exact_excess(receiver, terms, weights, is_reversed));
}

template float CriticalBias::find(const DepthTerm&, const std::array<scene::ExactTap, 1>&,
                                  const std::array<double, 1>&) const;
template float CriticalBias::find(const DepthTerm&, const std::array<scene::ExactTap, 4>&,
                                  const std::array<double, 4>&) const;

} // namespace gnomon::reference_rt
