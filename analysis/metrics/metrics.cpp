#include "analysis/metrics/metrics.hpp"

#include "analysis/pixels/statistics.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

/// Pixels per leaf of the reduction. Fixes the order in which absolute errors are added, so that
/// the sum is bitwise equal for any number of threads.
constexpr std::size_t pixels_per_leaf = 32768;
constexpr std::size_t no_pixel = std::numeric_limits<std::size_t>::max();

/// The contribution of one part of the image.
struct Tally {
    explicit Tally(int taps) : too_dark{taps}, too_bright{taps} {}

    /// By class, and by whether the verdict is lit: one histogram gives classes and errors.
    std::array<std::array<std::uint64_t, 2>, scene::pixel_class_count> by_verdict{};
    std::array<std::uint64_t, scene::class_reason_count> by_reason{};
    AmountSum too_dark; ///< over scored pixels
    AmountSum too_bright;
    std::array<double, error_sums.size()> sums{};
    /// First scored pixel whose verdict is outside [0, 1] or NaN.
    std::size_t first_bad_pixel = no_pixel;

    /// Has no branches that depend on the image, since classes change from pixel to pixel.
    void add(std::size_t pixel, const scene::Truth& truth, float verdict)
    {
        const PixelClass pixel_class = truth.pixel_class[pixel];
        ++by_verdict[static_cast<std::size_t>(pixel_class)][scene::is_lit(verdict) ? 1 : 0];
        ++by_reason[static_cast<std::size_t>(truth.reason[pixel])];
        const bool is_verdict = verdict >= 0.0F && verdict <= 1.0F;
        if (scene::is_scored(pixel_class) & !is_verdict) [[unlikely]] {
            first_bad_pixel = std::min(first_bad_pixel, pixel);
        }
        const bool is_measured = scene::is_scored(pixel_class) & is_verdict;
        const scene::VerdictError error =
            is_measured ? scene::error_of(truth.share(pixel), verdict) : scene::VerdictError{};
        too_dark.add(error.too_dark);
        too_bright.add(error.too_bright);
        add_sums({pixel_class, verdict, error}, is_measured,
                 std::make_index_sequence<error_sums.size()>{});
    }

    /// Unrolled over the rows at compile time, so that no function is called.
    template <std::size_t... row>
    void add_sums(const ScoredPixel& pixel, bool is_measured, std::index_sequence<row...> /*rows*/)
    {
        const std::array<double, sizeof...(row)> added{error_sums[row].of(pixel)...};
        ((sums[row] += is_measured ? added[row] : 0.0), ...);
    }

    void add(const Tally& other)
    {
        for (std::size_t i = 0; i < by_verdict.size(); ++i) {
            by_verdict[i][0] += other.by_verdict[i][0];
            by_verdict[i][1] += other.by_verdict[i][1];
        }
        for (std::size_t i = 0; i < by_reason.size(); ++i) {
            by_reason[i] += other.by_reason[i];
        }
        too_dark.add(other.too_dark);
        too_bright.add(other.too_bright);
        std::ranges::transform(sums, other.sums, sums.begin(), std::plus<>{});
        first_bad_pixel = std::min(first_bad_pixel, other.first_bad_pixel);
    }

    [[nodiscard]] std::uint64_t count(PixelClass pixel_class, bool verdict_is_lit) const
    {
        return by_verdict[static_cast<std::size_t>(pixel_class)][verdict_is_lit ? 1 : 0];
    }
    [[nodiscard]] ErrorAmounts amounts() const
    {
        ErrorAmounts all{.shadow = too_dark.value(), .light = too_bright.value()};
        for (std::size_t i = 0; i < sums.size(); ++i) {
            std::visit(
                [&](auto member) {
                    all.*member = static_cast<std::decay_t<decltype(all.*member)>>(sums[i]);
                },
                error_sums[i].member);
        }
        return all;
    }
};

void require_same_size(const scene::Truth& truth, const scene::LookupLayers& lookup)
{
    const scene::ImageSize size = truth.pixel_class.size();
    if (truth.reason.size() != size || lookup.samples.size() != size) {
        throw std::invalid_argument(
            fmt::format("measure: the layers differ in size: classes {}x{}, reasons {}x{}, "
                        "lookup {}x{}",
                        size.width_px, size.height_px, truth.reason.size().width_px,
                        truth.reason.size().height_px, lookup.samples.size().width_px,
                        lookup.samples.size().height_px));
    }
}

Tally tally_layers(const scene::Truth& truth, const scene::LookupLayers& lookup, int taps)
{
    const auto count = [&](const tbb::blocked_range<std::size_t>& pixels, Tally tally) {
        for (std::size_t i = pixels.begin(); i != pixels.end(); ++i) {
            tally.add(i, truth, lookup.samples[i].verdict);
        }
        return tally;
    };
    const auto join = [](Tally left, const Tally& right) {
        left.add(right);
        return left;
    };
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>{0, truth.pixel_class.pixel_count(), pixels_per_leaf},
        Tally{equal_steps(truth, taps)}, count, join);
}

} // namespace

std::uint64_t ClassCounts::scored() const
{
    return of(PixelClass::lit) + of(PixelClass::blocked);
}

ClassCounts& ClassCounts::operator+=(const ClassCounts& other)
{
    total += other.total;
    std::ranges::transform(by_class, other.by_class, by_class.begin(), std::plus<>{});
    std::ranges::transform(by_reason, other.by_reason, by_reason.begin(), std::plus<>{});
    return *this;
}

Metrics& Metrics::operator+=(const Metrics& other)
{
    pixels += other.pixels;
    amounts += other.amounts;
    return *this = make_metrics(
               pixels, {false_shadow + other.false_shadow, false_lit + other.false_lit, amounts});
}

std::uint64_t ClassCounts::surface() const
{
    return total - of(PixelClass::background);
}

bool has_fractions(const Metrics& metrics)
{
    return metrics.amounts.partial > 0 || metrics.amounts.unassigned > 0 ||
           metrics.amounts.shadow != static_cast<double>(metrics.false_shadow) ||
           metrics.amounts.light != static_cast<double>(metrics.false_lit);
}

ClassCounts count_classes(const scene::Truth& truth)
{
    ClassCounts counts;
    counts.total = truth.pixel_class.pixel_count();
    for (std::size_t i = 0; i < truth.pixel_class.pixel_count(); ++i) {
        ++counts.by_class[static_cast<std::size_t>(truth.pixel_class[i])];
        ++counts.by_reason[static_cast<std::size_t>(truth.reason[i])];
    }
    return counts;
}

Metrics make_metrics(const ClassCounts& pixels, const VerdictErrors& errors)
{
    Metrics metrics;
    metrics.pixels = pixels;
    metrics.false_shadow = errors.false_shadow;
    metrics.false_lit = errors.false_lit;
    const std::uint64_t scored = pixels.scored();
    metrics.false_shadow_rate = ratio(errors.false_shadow, pixels.of(PixelClass::lit));
    metrics.false_lit_rate = ratio(errors.false_lit, pixels.of(PixelClass::blocked));
    metrics.error_rate = ratio(errors.false_shadow + errors.false_lit, scored);
    metrics.amounts = errors.amounts;
    metrics.shadow_amount_rate = ratio(errors.amounts.shadow, pixels.of(PixelClass::lit));
    metrics.light_amount_rate = ratio(errors.amounts.light, pixels.of(PixelClass::blocked));
    metrics.mean_abs_error = ratio(errors.amounts.total(), scored);
    return metrics;
}

Metrics measure(const scene::Truth& truth, const scene::LookupLayers& lookup, int taps)
{
    require_same_size(truth, lookup);
    const Tally tally = tally_layers(truth, lookup, taps);
    if (tally.first_bad_pixel != no_pixel) {
        throw std::domain_error(
            fmt::format("measure: lookup: the verdict of scored pixel {} is {}, not in [0, 1]",
                        tally.first_bad_pixel, lookup.samples[tally.first_bad_pixel].verdict));
    }
    ClassCounts pixels;
    pixels.total = truth.pixel_class.pixel_count();
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        pixels.by_class[i] = tally.by_verdict[i][0] + tally.by_verdict[i][1];
    }
    pixels.by_reason = tally.by_reason;
    return make_metrics(pixels, {tally.count(PixelClass::lit, false),
                                 tally.count(PixelClass::blocked, true), tally.amounts()});
}

} // namespace gnomon::analysis
