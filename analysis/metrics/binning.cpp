#include "analysis/metrics/binning.hpp"

#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

void require_bins(std::string_view function, int bins)
{
    if (bins < 1 || bins > Binning::most_bins) {
        throw std::invalid_argument(
            fmt::format("{}: bins: {} is not in [1, {}]", function, bins, Binning::most_bins));
    }
}

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
};

/// @param argument  Function and argument that hold the values, for error messages.
Range scored_range(std::string_view argument, const scene::Image<PixelClass>& classes,
                   const scene::Image<float>& values)
{
    Range range;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        if (!std::isfinite(values[i])) {
            throw std::invalid_argument(
                fmt::format("{}: scored pixel {} has {}", argument, i, values[i]));
        }
        range.lower = std::min(range.lower, double{values[i]});
        range.upper = std::max(range.upper, double{values[i]});
    }
    return range;
}

/// Bins over the range, without pixels; none if the range is empty.
Binning bins_over(const Range& range, BinScale scale, int bins)
{
    Binning binning;
    if (range.lower <= range.upper) {
        binning.scale = scale;
        binning.lower = range.lower;
        binning.upper = range.upper;
        binning.bins = range.lower < range.upper ? bins : 1;
    }
    return binning;
}

/// The value's position among the bins, from 0 to their number.
double position_of(const Binning& binning, double value)
{
    const double share =
        binning.scale == BinScale::linear
            ? (value - binning.lower) / (binning.upper - binning.lower)
            : std::log(value / binning.lower) / std::log(binning.upper / binning.lower);
    return share * binning.bins;
}

/// The value's bin. The quotient may round across an edge, so the edges decide.
std::uint8_t bin_of(const Binning& binning, double value)
{
    if (!(binning.upper > binning.lower)) {
        return 0;
    }
    const int last = binning.bins - 1;
    int i = std::min(static_cast<int>(std::max(position_of(binning, value), 0.0)), last);
    while (i > 0 && value < binning.edge(i)) {
        --i;
    }
    while (i < last && value >= binning.edge(i + 1)) {
        ++i;
    }
    return static_cast<std::uint8_t>(i);
}

/// Sorts the scored pixels into bins by value.
template <typename ValueOf>
void fill(Binning& binning, const scene::Image<PixelClass>& classes, const ValueOf& value_of)
{
    constexpr std::uint8_t no_bin = 255;
    scene::Image<std::uint8_t> bin{classes.size(), no_bin};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (scene::is_scored(classes[i])) {
                bin[i] = bin_of(binning, value_of(i));
            }
        }
    });
    std::array<std::size_t, no_bin + std::size_t{1}> next{}; // where each bin's next pixel goes
    for (const std::uint8_t each : bin) {
        ++next[each];
    }
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    binning.image = classes.size();
    binning.pixels.resize(next[no_bin]);
    for (std::size_t i = 0; i < bin.pixel_count(); ++i) {
        if (bin[i] != no_bin) {
            binning.pixels[next[bin[i]]++] = static_cast<std::uint32_t>(i);
        }
    }
    binning.ends.assign(next.begin(), next.begin() + binning.bins);
}

} // namespace

double Binning::edge(int i) const
{
    const double share = static_cast<double>(i) / bins;
    if (scale == BinScale::linear || i == 0 || i == bins) {
        return std::lerp(lower, upper, share);
    }
    return lower * std::pow(upper / lower, share);
}

Binning bin_by_distance(const scene::Image<PixelClass>& classes,
                        const scene::Image<float>& light_distance_m, int bins)
{
    require_bins("bin_by_distance", bins);
    require_equal_sizes("bin_by_distance", classes.size(), {light_distance_m.size()});
    Binning binning =
        bins_over(scored_range("bin_by_distance: light_distance_m", classes, light_distance_m),
                  BinScale::linear, bins);
    fill(binning, classes, [&](std::size_t i) { return double{light_distance_m[i]}; });
    return binning;
}

Binning bin_by_view_depth(const scene::Image<PixelClass>& classes,
                          const scene::Image<float>& view_depth_m, int bins)
{
    require_bins("bin_by_view_depth", bins);
    require_equal_sizes("bin_by_view_depth", classes.size(), {view_depth_m.size()});
    const Range range = scored_range("bin_by_view_depth: view_depth_m", classes, view_depth_m);
    if (!(range.lower > 0)) {
        throw std::invalid_argument(fmt::format(
            "bin_by_view_depth: view_depth_m: a scored pixel has {}, which is not above 0",
            range.lower));
    }
    Binning binning = bins_over(range, BinScale::logarithmic, bins);
    fill(binning, classes, [&](std::size_t i) { return double{view_depth_m[i]}; });
    return binning;
}

Binning bin_by_angle(const scene::Image<PixelClass>& classes, const scene::LookupLayers& lookup,
                     int bins)
{
    require_bins("bin_by_angle", bins);
    require_equal_sizes("bin_by_angle", classes.size(), {lookup.samples.size()});
    Binning binning;
    binning.upper = std::numbers::pi / 2;
    binning.bins = bins;
    fill(binning, classes,
         [&](std::size_t i) { return std::atan(double{lookup.samples[i].tan_theta}); });
    return binning;
}

} // namespace gnomon::analysis
