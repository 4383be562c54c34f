#include "reference_rt/light/critical_bias.hpp"

#include "scene/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::reference_rt {

namespace {

using scene::infinity;

/// What a texel's ray meets; it stays where it is, as the hit refers to its ray and triangle.
struct TapHit {
    CameraRay ray;
    ExactTriangle face;
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
Bounded directed(const Bounded& excess, bool is_reversed)
{
    return is_reversed ? Bounded{-excess.value, excess.error} : excess;
}
Wide directed(const Wide& excess, bool is_reversed)
{
    return is_reversed ? WideField::number(0) - excess : excess;
}
Fraction directed(const Fraction& excess, bool is_reversed)
{
    return is_reversed ? Fraction{Dyadic{} - excess.numerator, excess.denominator} : excess;
}

/// The precisions that are tried one after the other, and the weights in them.
struct InDoubles {
    static auto of(const BilinearWeights& weights) { return weights.bounded(); }
};
struct InTwiceDoubles {
    static auto of(const BilinearWeights& weights) { return weights.sharp(); }
};
struct Exactly {
    static auto of(const BilinearWeights& weights) { return weights.exact(); }
};

template <typename T, std::size_t n, typename Function>
auto mapped(const std::array<T, n>& values, const Function& function)
{
    std::array<decltype(function(values[0])), n> results;
    std::ranges::transform(values, results.begin(), function);
    return results;
}

/// One tap counts for all.
struct UnitWeight {};

/// r − d
template <typename Number>
Number mean_excess(const Number& receiver, const std::array<Number, 1>& depths,
                   const UnitWeight& /*weight*/)
{
    return receiver - depths[0];
}
/// r − Σ w·d = Σ w·(r − d), as the weights' sum is 1: what is uncertain of a weight counts for
/// less.
template <typename Number>
Number mean_excess(const Number& receiver, const std::array<Number, 4>& depths,
                   const std::array<Number, 4>& weights)
{
    Number excess = weights[0] * (receiver - depths[0]);
    for (std::size_t i = 1; i < depths.size(); ++i) {
        excess = excess + weights[i] * (receiver - depths[i]);
    }
    return excess;
}
/// The same; what is 0 is left out, as these numbers grow with each sum.
Fraction mean_excess(const Fraction& receiver, const std::array<Fraction, 4>& depths,
                     const std::array<Fraction, 4>& weights)
{
    Fraction excess = number(0);
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const Fraction term = weights[i] * (depths[i] - receiver);
        excess = term.denominator.sign() == 0 || term.sign() != 0 ? excess - term : excess;
    }
    return excess;
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
    return hit_->is_well_scaled() ? depth_->widely_at(*hit_)
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

float CriticalBias::find(const DepthTerm& receiver, const scene::ExactTap& tap) const
{
    return find(receiver, std::array{tap}, [](auto /*precision*/) { return UnitWeight{}; });
}

float CriticalBias::find(const DepthTerm& receiver, const std::array<scene::ExactTap, 4>& taps,
                         const BilinearWeights& weights) const
{
    return find(receiver, taps, [&](auto precision) { return precision.of(weights); });
}

template <std::size_t n, typename Weights>
float CriticalBias::find(const DepthTerm& receiver, const std::array<scene::ExactTap, n>& taps,
                         const Weights& weights) const
{
    const bool is_reversed = depth_.is_reversed();
    const auto known = mapped(taps, known_depth);
    const auto bounded = mean_excess(receiver.bounded(), known, weights(InDoubles{}));
    if (const auto bias = certain_bias(directed(bounded, is_reversed))) {
        return *bias;
    }
    std::array<TapHit, n> hits;
    std::array<DepthTerm, n> terms;
    SignCounts counts;
    for (std::size_t i = 0; i < n; ++i) {
        if (taps[i].triangle == scene::no_triangle) {
            terms[i] = DepthTerm{taps[i].depth};
        } else {
            TapHit& tap = hits[i];
            tap.ray = CameraRay{rays_.ray(taps[i].texel)};
            tap.face = ExactTriangle{taps[i].triangle, corners_of(triangles_, taps[i].triangle)};
            tap.hit = Receiver{tap.face, tap.ray, counts};
            terms[i] = DepthTerm{depth_, tap.hit, known[i]};
        }
    }
    const auto sharp_depths = mapped(terms, [](const DepthTerm& term) { return term.sharp(); });
    const auto sharp = mean_excess(receiver.sharp(), sharp_depths, weights(InTwiceDoubles{}));
    if (const auto bias = certain_bias(directed(sharp, is_reversed))) {
        return *bias;
    }
    const auto exact_depths = mapped(terms, [](const DepthTerm& term) { return term.exact(); });
    const auto exact = mean_excess(receiver.exact(), exact_depths, weights(Exactly{}));
    return smallest_bias_of(directed(exact, is_reversed));
}

} // namespace gnomon::reference_rt
