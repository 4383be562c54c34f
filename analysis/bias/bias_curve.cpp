#include "analysis/bias/bias_curve.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "analysis/pixels/radix_sort.hpp"
#include "analysis/pixels/statistics.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::infinity;
using scene::PixelClass;

void require_same_size(scene::ImageSize criticals, scene::ImageSize classes)
{
    if (criticals != classes) {
        throw std::invalid_argument(fmt::format(
            "BiasCurve: criticals: {}x{}, but the classes are {}x{}", criticals.width_px,
            criticals.height_px, classes.width_px, classes.height_px));
    }
}

struct ScoredCriticals {
    std::vector<float> lit;
    std::vector<float> blocked;
};

[[noreturn]] void reject_nan(const scene::Image<float>& criticals,
                             const scene::Image<PixelClass>& classes)
{
    std::size_t i = 0;
    while (!scene::is_scored(classes[i]) || !std::isnan(criticals[i])) {
        ++i;
    }
    throw std::invalid_argument(fmt::format("BiasCurve: criticals: NaN at scored pixel {}", i));
}

/// Has no branches that depend on the image, since classes change from pixel to pixel. Writes every
/// value to both lists; it stays where the list grows.
ScoredCriticals gather_scored(const scene::Image<float>& criticals,
                              const scene::Image<PixelClass>& classes)
{
    const auto count = [&](PixelClass pixel_class) {
        return static_cast<std::size_t>(std::count(classes.begin(), classes.end(), pixel_class));
    };
    const std::size_t lit_count = count(PixelClass::lit);
    const std::size_t blocked_count = count(PixelClass::blocked);
    ScoredCriticals scored{std::vector<float>(lit_count + 1),
                           std::vector<float>(blocked_count + 1)};
    float* lit = scored.lit.data();
    float* blocked = scored.blocked.data();
    bool has_nan = false;
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        *lit = criticals[i];
        *blocked = criticals[i];
        lit += scene::is_lit(classes[i]) ? 1 : 0;
        blocked += scene::is_blocked(classes[i]) ? 1 : 0;
        has_nan = has_nan || (std::isnan(criticals[i]) && scene::is_scored(classes[i]));
    }
    if (has_nan) {
        reject_nan(criticals, classes);
    }
    scored.lit.resize(lit_count);
    scored.blocked.resize(blocked_count);
    return scored;
}

/// A finite bias of the interval: its lower end if that is finite.
float lowest_finite(const BiasInterval& interval)
{
    if (std::isfinite(interval.lo)) {
        return interval.lo;
    }
    return std::isfinite(interval.hi) ? interval.hi : 0.0F;
}

std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& points, std::size_t most_points)
{
    if (points.size() <= most_points) {
        return points;
    }
    std::vector<CurvePoint> result;
    result.reserve(most_points);
    for (std::size_t i = 0; i < most_points; ++i) {
        result.push_back(points[i * (points.size() - 1) / (most_points - 1)]);
    }
    return result;
}

/// Finite critical biases of all scored pixels, ascending, with repetitions.
std::vector<float> finite_criticals(const BiasCurve& curve)
{
    std::vector<float> all(curve.scored());
    std::merge(curve.lit().begin(), curve.lit().end(), curve.blocked().begin(),
               curve.blocked().end(), all.begin());
    const auto first = std::upper_bound(all.begin(), all.end(), -infinity);
    const auto last = std::lower_bound(first, all.end(), infinity);
    return {first, last};
}

/// Appends biases in a geometric sequence over the positive criticals.
void append_logarithmic(std::vector<float>& biases, const std::vector<float>& criticals,
                        std::size_t count)
{
    const auto positive = std::upper_bound(criticals.begin(), criticals.end(), 0.0F);
    if (positive == criticals.end()) {
        return;
    }
    const double first = std::log(double{*positive});
    const double last = std::log(double{criticals.back()});
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        const auto bias = static_cast<float>(std::exp(std::lerp(first, last, share)));
        biases.push_back(std::clamp(bias, *positive, criticals.back()));
    }
}

void sort_and_remove_repeats(std::vector<float>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

} // namespace

float BiasInterval::middle() const
{
    if (!std::isfinite(lo) || !std::isfinite(hi)) {
        return lowest_finite(*this);
    }
    const auto mean = static_cast<float>(0.5 * (double{lo} + double{hi}));
    // Biases are never subnormal, and an interval with a subnormal middle contains 0.
    return std::fpclassify(mean) == FP_SUBNORMAL ? 0.0F : mean;
}

BiasCurve::BiasCurve(const scene::Image<float>& criticals, const scene::Image<PixelClass>& classes)
{
    require_same_size(criticals.size(), classes.size());
    ScoredCriticals scored = gather_scored(criticals, classes);
    lit_ = std::move(scored.lit);
    blocked_ = std::move(scored.blocked);
    tbb::parallel_invoke([&] { radix_sort(lit_); }, [&] { radix_sort(blocked_); });
}

ErrorCounts BiasCurve::at(float bias) const
{
    if (bias != 0.0F && !std::isnormal(bias)) {
        throw std::invalid_argument(
            fmt::format("BiasCurve::at: bias: {} is neither 0 nor a normal float32", bias));
    }
    const auto right = std::upper_bound(lit_.begin(), lit_.end(), bias);
    const auto wrong = std::upper_bound(blocked_.begin(), blocked_.end(), bias);
    return {static_cast<std::uint64_t>(lit_.end() - right),
            static_cast<std::uint64_t>(wrong - blocked_.begin())};
}

std::optional<double> BiasCurve::error_rate(const ErrorCounts& errors) const
{
    return ratio(errors.total(), scored());
}

std::optional<double> BiasCurve::false_shadow_rate(const ErrorCounts& errors) const
{
    return ratio(errors.false_shadow, lit_.size());
}

std::optional<double> BiasCurve::false_lit_rate(const ErrorCounts& errors) const
{
    return ratio(errors.false_lit, blocked_.size());
}

bool is_better(const BestBiases& a, const BestBiases& b)
{
    return a.errors.total() < b.errors.total() ||
           (a.errors.total() == b.errors.total() && a.interval.width() > b.interval.width());
}

BestBiases find_best_biases(const BiasCurve& curve, const BiasInterval& within)
{
    if (!(within.lo <= within.hi)) {
        throw std::invalid_argument(fmt::format(
            "find_best_biases: within: lo = {} is above hi = {}", within.lo, within.hi));
    }
    // Starts with more errors than any bias has.
    BestBiases best{within, {curve.scored() + 1, 0}};
    BestBiases run = best; // neighbouring intervals with equally many errors
    const auto finish_run = [&] {
        if (is_better(run, best)) {
            best = run;
        }
    };
    for_each_interval(
        curve.lit(), curve.blocked(), [&](BiasInterval interval, const ErrorCounts& errors) {
            interval = {std::max(interval.lo, within.lo), std::min(interval.hi, within.hi)};
            if (interval.lo > interval.hi) {
                return;
            }
            if (errors.total() == run.errors.total()) {
                run.interval.hi = interval.hi;
            } else {
                finish_run();
                run = {interval, errors};
            }
        });
    finish_run();
    return best;
}

std::optional<BiasInterval> biases_with_at_most(const BiasCurve& curve, const ErrorCounts& most)
{
    const auto& lit = curve.lit();
    const auto& blocked = curve.blocked();
    BiasInterval interval = every_bias;
    if (most.false_shadow < lit.size()) {
        interval.lo = lit[lit.size() - 1 - most.false_shadow];
    }
    if (most.false_lit < blocked.size()) {
        interval.hi = previous_bias(blocked[most.false_lit]);
    }
    const bool is_possible =
        interval.lo <= interval.hi && interval.lo != infinity && interval.hi != -infinity;
    return is_possible ? std::optional{interval} : std::nullopt;
}

std::vector<CurvePoint> pareto_front(const BiasCurve& curve, std::size_t most_points)
{
    if (most_points < 2) {
        throw std::invalid_argument(
            fmt::format("pareto_front: most_points: {} is below 2", most_points));
    }
    // As the bias grows, false shadow never grows and false lit never falls. So a point is optimal
    // if the one before it has more false shadow and the one after it more false lit.
    std::vector<CurvePoint> front;
    for_each_interval(
        curve.lit(), curve.blocked(), [&](const BiasInterval& interval, const ErrorCounts& errors) {
            const CurvePoint point{lowest_finite(interval), errors};
            if (front.empty() || errors.false_lit > front.back().errors.false_lit) {
                if (front.empty() || errors.false_shadow < front.back().errors.false_shadow) {
                    front.push_back(point);
                }
            } else if (errors.false_shadow < front.back().errors.false_shadow) {
                front.back() = point;
            }
        });
    return thinned(front, most_points);
}

std::vector<float> sample_biases(const BiasCurve& curve, std::size_t most_points)
{
    if (most_points < 8) {
        throw std::invalid_argument(
            fmt::format("sample_biases: most_points: {} is below 8", most_points));
    }
    std::vector<float> biases{0.0F};
    const std::vector<float> criticals = finite_criticals(curve);
    if (!criticals.empty()) {
        std::vector<float> distinct = criticals;
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        const float below = previous_bias(distinct.front());
        biases.push_back(below);
        if (distinct.size() <= most_points - 2) {
            biases.insert(biases.end(), distinct.begin(), distinct.end());
        } else {
            const std::size_t count = (most_points - 2) / 2;
            for (std::size_t i = 0; i < count; ++i) {
                biases.push_back(criticals[i * (criticals.size() - 1) / (count - 1)]);
            }
            append_logarithmic(biases, criticals, count);
        }
    }
    sort_and_remove_repeats(biases);
    return biases;
}

} // namespace gnomon::analysis
