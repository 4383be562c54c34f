#include "analysis/metrics.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

/// Pixels per leaf of the reduction. It fixes the order in which the absolute errors are added, so
/// that their sum has the same bits for any number of threads.
constexpr std::size_t pixels_per_leaf = 32768;
constexpr std::size_t no_pixel = std::numeric_limits<std::size_t>::max();

/// What one part of the image adds to the metrics.
struct Tally {
    std::array<std::uint64_t, scene::pixel_class_count> by_class{};
    std::array<std::uint64_t, 7> by_reason{};
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
    double absolute_error = 0;
    std::size_t first_bad_pixel = no_pixel; ///< a verdict outside [0, 1], or NaN

    void add_verdict(std::size_t pixel, bool truth_is_lit, float verdict)
    {
        if (!(verdict >= 0.0F && verdict <= 1.0F)) {
            first_bad_pixel = std::min(first_bad_pixel, pixel);
            return;
        }
        const bool verdict_is_lit = scene::is_lit(verdict);
        false_shadow += (truth_is_lit && !verdict_is_lit) ? 1U : 0U;
        false_lit += (!truth_is_lit && verdict_is_lit) ? 1U : 0U;
        absolute_error += std::abs(static_cast<double>(verdict) - (truth_is_lit ? 1.0 : 0.0));
    }

    void add(const Tally& other)
    {
        std::ranges::transform(by_class, other.by_class, by_class.begin(), std::plus{});
        std::ranges::transform(by_reason, other.by_reason, by_reason.begin(), std::plus{});
        false_shadow += other.false_shadow;
        false_lit += other.false_lit;
        absolute_error += other.absolute_error;
        first_bad_pixel = std::min(first_bad_pixel, other.first_bad_pixel);
    }
};

void require_same_size(const scene::TruthLayers& truth, const scene::LookupLayers& lookup)
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

Tally tally_layers(const scene::TruthLayers& truth, const scene::LookupLayers& lookup)
{
    const auto count = [&](const tbb::blocked_range<std::size_t>& pixels, Tally tally) {
        for (std::size_t i = pixels.begin(); i != pixels.end(); ++i) {
            const scene::PixelClass pixel_class = truth.pixel_class[i];
            ++tally.by_class[static_cast<std::size_t>(pixel_class)];
            ++tally.by_reason[static_cast<std::size_t>(truth.reason[i])];
            if (scene::is_scored(pixel_class)) {
                tally.add_verdict(i, pixel_class == scene::PixelClass::lit,
                                  lookup.samples[i].verdict);
            }
        }
        return tally;
    };
    const auto join = [](Tally left, const Tally& right) {
        left.add(right);
        return left;
    };
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>{0, truth.pixel_class.pixel_count(), pixels_per_leaf},
        Tally{}, count, join);
}

std::optional<double> ratio(double part, std::uint64_t whole)
{
    if (whole == 0) {
        return std::nullopt;
    }
    return part / static_cast<double>(whole);
}

} // namespace

std::uint64_t ClassCounts::scored() const
{
    return of(scene::PixelClass::lit) + of(scene::PixelClass::blocked);
}

std::uint64_t ClassCounts::surface() const { return total - of(scene::PixelClass::background); }

Metrics measure(const scene::TruthLayers& truth, const scene::LookupLayers& lookup)
{
    require_same_size(truth, lookup);
    const Tally tally = tally_layers(truth, lookup);
    if (tally.first_bad_pixel != no_pixel) {
        throw std::domain_error(
            fmt::format("measure: lookup: the verdict of scored pixel {} is {}, not in [0, 1]",
                        tally.first_bad_pixel, lookup.samples[tally.first_bad_pixel].verdict));
    }
    Metrics metrics;
    metrics.pixels = {truth.pixel_class.pixel_count(), tally.by_class, tally.by_reason};
    metrics.false_shadow = tally.false_shadow;
    metrics.false_lit = tally.false_lit;
    const std::uint64_t scored = metrics.pixels.scored();
    const auto false_shadow = static_cast<double>(tally.false_shadow);
    const auto false_lit = static_cast<double>(tally.false_lit);
    metrics.false_shadow_rate = ratio(false_shadow, metrics.pixels.of(scene::PixelClass::lit));
    metrics.false_lit_rate = ratio(false_lit, metrics.pixels.of(scene::PixelClass::blocked));
    metrics.error_rate = ratio(false_shadow + false_lit, scored);
    metrics.mean_abs_error = ratio(tally.absolute_error, scored);
    return metrics;
}

} // namespace gnomon::analysis
