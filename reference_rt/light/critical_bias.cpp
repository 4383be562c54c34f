#include "reference_rt/light/critical_bias.hpp"

#include "reference_rt/light/float_rounding.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::reference_rt {

namespace {

using scene::infinity;

/// Up to the next bias: 0 or a normal float32.
struct UpToBias {
    static float of(double x) { return smallest_bias_from(x); }
    static double boundary(float lower, float /*upper*/) { return static_cast<double>(lower); }
};

/// What a bias must make up for: r − d, or reversed d − r.
Interval directed(const Interval& excess, bool is_reversed)
{
    return is_reversed ? Interval{-excess.value, excess.error} : excess;
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
struct InDoubleDoubles {
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
    Fraction excess = Fraction::number(0);
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const Fraction term = weights[i] * (depths[i] - receiver);
        excess = term.denominator.sign() == 0 || term.sign() != 0 ? excess - term : excess;
    }
    return excess;
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

float CriticalBias::find(const DepthTerm& receiver, const renderers::ExactTap& tap) const
{
    return find(receiver, std::array{tap}, [](auto /*precision*/) { return UnitWeight{}; });
}

float CriticalBias::find(const DepthTerm& receiver, const std::array<renderers::ExactTap, 4>& taps,
                         const BilinearWeights& weights) const
{
    return find(receiver, taps, [&](auto precision) { return precision.of(weights); });
}

template <std::size_t n, typename Weights>
float CriticalBias::find(const DepthTerm& receiver, const std::array<renderers::ExactTap, n>& taps,
                         const Weights& weights) const
{
    const bool is_reversed = taps_.is_reversed();
    const auto known = mapped(taps, TapDepths::known);
    const auto bounded = mean_excess(receiver.bounded(), known, weights(InDoubles{}));
    if (const auto bias = certainly_rounded<UpToBias>(directed(bounded, is_reversed))) {
        return *bias;
    }
    std::array<TapHit, n> hits;
    std::array<DepthTerm, n> terms;
    for (std::size_t i = 0; i < n; ++i) {
        terms[i] = taps_.term(taps[i], hits[i]);
    }
    const auto sharp_depths = mapped(terms, [](const DepthTerm& term) { return term.sharp(); });
    const auto sharp = mean_excess(receiver.sharp(), sharp_depths, weights(InDoubleDoubles{}));
    if (const auto bias = certainly_rounded<UpToBias>(directed(sharp, is_reversed))) {
        return *bias;
    }
    const auto exact_depths = mapped(terms, [](const DepthTerm& term) { return term.exact(); });
    const ExactDepth exact_receiver = receiver.exact();
    if (exact_receiver.is_square || std::ranges::any_of(exact_depths, &ExactDepth::is_square)) {
        if (n > 1) {
            throw std::logic_error{"CriticalBias: a mean of distances has no exact sign"};
        }
        const ExactDepth& depth = exact_depths.front();
        return exactly_rounded<UpToBias>(ShiftedRoots{{exact_receiver.square(), depth.square()},
                                                      exact_receiver.shift - depth.shift});
    }
    const auto numbers = mapped(exact_depths, [](const ExactDepth& depth) { return depth.number; });
    const auto exact = mean_excess(exact_receiver.number, numbers, weights(Exactly{}));
    return exact.denominator.sign() == 0 ? infinity
                                         : exactly_rounded<UpToBias>(directed(exact, is_reversed));
}

} // namespace gnomon::reference_rt
