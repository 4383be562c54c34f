#include "reference_rt/light/critical_bias.hpp"

#include "reference_rt/light/float_rounding.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::reference_rt {

DoubleDouble DepthTerm::sharp() const
{
    if (hit_ != nullptr && !hit_->is_well_scaled()) {
        return DoubleDouble{0, 0, std::numeric_limits<double>::infinity()};
    }
    const DoubleDouble depth = hit_ == nullptr        ? DoubleDoubleField::number(constant_)
                               : distance_ != nullptr ? distance_->at_double_double(*hit_, offset_)
                                                      : depth_->at_double_double(*hit_, offset_);
    return shift_ == 0 ? depth : depth + DoubleDoubleField::number(shift_);
}

ExactDepth DepthTerm::exact() const
{
    ExactDepth depth = hit_ == nullptr ? ExactDepth{Fraction::number(constant_), false}
                       : distance_ != nullptr
                           ? distance_->exactly_at(*hit_, offset_)
                           : ExactDepth{depth_->exactly_at(*hit_, offset_), false};
    if (depth.is_square) {
        depth.shift = shift_;
    } else if (shift_ != 0) {
        depth.number = depth.number - Fraction::number(-shift_);
    }
    return depth;
}

DepthTerm DepthTerm::shifted(double by) const
{
    if (by == 0) {
        return *this;
    }
    DepthTerm moved = *this;
    moved.shift_ += by;
    moved.interval_ = interval_ + Interval{by, 0};
    return moved;
}

Sign DepthTerm::sign_beyond(double number) const
{
    const ExactDepth depth = exact();
    return depth.is_square
               ? ShiftedRoots{{depth.number, Fraction::number(0)}, depth.shift}.sign_beyond(number)
               : depth.number.sign_beyond(number);
}

DepthTerm DepthTerm::clamped() const
{
    const Interval rest = Interval{1, 0} - interval_;
    if (interval_.is_certainly_positive() && rest.is_certainly_positive()) {
        return *this;
    }
    if (sign_beyond(0) < 0) {
        return DepthTerm{0};
    }
    return sign_beyond(1) > 0 ? DepthTerm{1} : *this;
}

float DepthTerm::nearest_float() const
{
    if (const auto depth = certainly_rounded<ToNearest>(bounded())) {
        return *depth;
    }
    if (const auto depth = certainly_rounded<ToNearest>(sharp())) {
        return *depth;
    }
    const auto [depth, is_square, shift] = exact();
    if (is_square) {
        return exactly_rounded<ToNearest>(ShiftedRoots{{depth, Fraction::number(0)}, shift});
    }
    return depth.denominator.sign() == 0 ? std::numeric_limits<float>::quiet_NaN()
                                         : exactly_rounded<ToNearest>(depth);
}

DepthTerm TapDepths::term(const renderers::ExactTap& tap, TapHit& hit) const
{
    if (tap.triangle == scene::no_triangle) {
        return DepthTerm{tap.depth}.shifted(tap.shift);
    }
    SignCounts counts;
    const auto map = static_cast<std::size_t>(tap.texel.map);
    hit.ray = CameraRay{maps_.rays[map].ray(tap.texel)};
    hit.face = {triangles_, tap.triangle};
    hit.hit = Receiver{hit.face, hit.ray, counts};
    if (const LightDistance* distance = maps_.distance(map)) {
        return DepthTerm{*distance, hit.hit, distance->at(hit.hit)}
            .clamped() // nothing lies beyond far
            .shifted(tap.shift);
    }
    return DepthTerm{maps_.depths[map], hit.hit, known_hit(tap)}.shifted(tap.shift);
}

float TapDepths::nearest_float(const renderers::ExactTap& tap) const
{
    if (const auto depth = certainly_rounded<ToNearest>(known(tap))) {
        return *depth; // usually, without recomputing the hit
    }
    TapHit hit;
    return term(tap, hit).nearest_float();
}

namespace {

using scene::infinity;

/// Rounds up to the next bias: 0 or a normal float32.
struct UpToBias {
    static float of(double x) { return smallest_bias_from(x); }
    static double boundary(float lower, float /*upper*/) { return static_cast<double>(lower); }
};

/// The excess that a bias must cover: r − d, or d − r if reversed.
Interval directed(const Interval& excess, bool is_reversed)
{
    return is_reversed ? Interval{-excess.value, excess.error} : excess;
}
DoubleDouble directed(const DoubleDouble& excess, bool is_reversed)
{
    return is_reversed ? DoubleDoubleField::number(0) - excess : excess;
}
Fraction directed(const Fraction& excess, bool is_reversed)
{
    return is_reversed ? Fraction{Dyadic{} - excess.numerator, excess.denominator} : excess;
}

/// The precisions to try in turn, with the weights in each.
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

/// The weight of a single tap.
struct UnitWeight {};

/// r − d
template <typename Number>
Number mean_excess(const Number& receiver, const std::array<Number, 1>& depths,
                   const UnitWeight& /*weight*/)
{
    return receiver - depths[0];
}
/// r − Σ w·d = Σ w·(r − d), as the weights sum to 1. In this form the weights' errors count for
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
/// As above, without zero terms, as exact numbers grow with each sum.
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
