#include "analysis/metrics.hpp"

#include "analysis/ratio.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

/// Pixels per leaf of the reduction. It fixes the order in which the absolute errors are added, so
/// that their sum has the same bits for any number of threads.
constexpr std::size_t pixels_per_leaf = 32768;
constexpr std::size_t no_pixel = std::numeric_limits<std::size_t>::max();

/// What one part of the image adds to the metrics.
struct Tally {
    /// By class, and by whether the verdict is lit: one histogram answers classes and errors.
    std::array<std::array<std::uint64_t, 2>, scene::pixel_class_count> by_verdict{};
    std::array<std::uint64_t, 7> by_reason{};
    double absolute_error = 0;
    std::size_t first_bad_pixel = no_pixel; ///< a scored verdict outside [0, 1], or NaN

    /// Without branches that depend on the image, for classes change from pixel to pixel.
    void add(std::size_t pixel, PixelClass pixel_class, scene::ClassReason reason, float verdict)
    {
        ++by_verdict[static_cast<std::size_t>(pixel_class)][scene::is_lit(verdict) ? 1 : 0];
        ++by_reason[static_cast<std::size_t>(reason)];
        const bool is_verdict = verdict >= 0.0F && verdict <= 1.0F;
        if (scene::is_scored(pixel_class) & !is_verdict) [[unlikely]] {
            first_bad_pixel = std::min(first_bad_pixel, pixel);
        }
        const float truth = pixel_class == PixelClass::lit ? 1.0F : 0.0F;
        const double error = std::abs(static_cast<double>(verdict) - static_cast<double>(truth));
        absolute_error += scene::is_scored(pixel_class) ? error : 0.0;
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
        absolute_error += other.absolute_error;
        first_bad_pixel = std::min(first_bad_pixel, other.first_bad_pixel);
    }

    [[nodiscard]] std::uint64_t count(PixelClass pixel_class, bool verdict_is_lit) const
    {
        return by_verdict[static_cast<std::size_t>(pixel_class)][verdict_is_lit ? 1 : 0];
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
            tally.add(i, truth.pixel_class[i], truth.reason[i], lookup.samples[i].verdict);
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

} // namespace

std::uint64_t ClassCounts::scored() const
{
    return of(PixelClass::lit) + of(PixelClass::blocked);
}

std::uint64_t ClassCounts::surface() const
{
    return total - of(PixelClass::background);
}

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
    metrics.pixels.total = truth.pixel_class.pixel_count();
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        metrics.pixels.by_class[i] = tally.by_verdict[i][0] + tally.by_verdict[i][1];
    }
    metrics.pixels.by_reason = tally.by_reason;
    metrics.false_shadow = tally.count(PixelClass::lit, false);
    metrics.false_lit = tally.count(PixelClass::blocked, true);
    const std::uint64_t scored = metrics.pixels.scored();
    const auto false_shadow = static_cast<double>(metrics.false_shadow);
    const auto false_lit = static_cast<double>(metrics.false_lit);
    metrics.false_shadow_rate = ratio(false_shadow, metrics.pixels.of(PixelClass::lit));
    metrics.false_lit_rate = ratio(false_lit, metrics.pixels.of(PixelClass::blocked));
    metrics.error_rate = ratio(false_shadow + false_lit, scored);
    metrics.mean_abs_error = ratio(tally.absolute_error, scored);
    return metrics;
}

} // namespace gnomon::analysis
