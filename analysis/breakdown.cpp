#include "analysis/breakdown.hpp"

#include "analysis/pixel_runs.hpp"
#include "analysis/ratio.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

void count_pixel(PartCounts& counts, PixelClass pixel_class, bool is_lit)
{
    if (pixel_class == PixelClass::lit) {
        ++counts.lit;
        counts.false_shadow += is_lit ? 0 : 1;
    } else {
        ++counts.blocked;
        counts.false_lit += is_lit ? 1 : 0;
    }
}

void require_bins(std::string_view function, int bins)
{
    if (bins < 1 || bins >= Binning::no_bin) {
        throw std::invalid_argument(
            fmt::format("{}: bins: {} is not from 1 to {}", function, bins, Binning::no_bin - 1));
    }
}

void require_size(std::string_view function, scene::ImageSize size, scene::ImageSize expected)
{
    if (size != expected) {
        throw std::invalid_argument(fmt::format("{}: the images differ in size", function));
    }
}

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
};

Range scored_range(const scene::Image<PixelClass>& classes, const scene::Image<float>& zeta_m)
{
    Range range;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        if (!std::isfinite(zeta_m[i])) {
            throw std::invalid_argument(fmt::format(
                "bin_by_distance: zeta_m: that of scored pixel {} is {}", i, zeta_m[i]));
        }
        range.lower = std::min(range.lower, double{zeta_m[i]});
        range.upper = std::max(range.upper, double{zeta_m[i]});
    }
    return range;
}

/// The value's bin; the quotient may round across an edge, and the edges decide.
std::uint8_t bin_of(const Binning& binning, double value)
{
    if (!(binning.upper > binning.lower)) {
        return 0;
    }
    const int last = binning.bins - 1;
    const double position =
        (value - binning.lower) / (binning.upper - binning.lower) * binning.bins;
    int i = std::min(static_cast<int>(std::max(position, 0.0)), last);
    while (i > 0 && value < binning.edge(i)) {
        --i;
    }
    while (i < last && value >= binning.edge(i + 1)) {
        ++i;
    }
    return static_cast<std::uint8_t>(i);
}

/// Puts each scored pixel into the bin of its value.
template <typename ValueOf>
void fill(Binning& binning, const scene::Image<PixelClass>& classes, const ValueOf& value_of)
{
    binning.bin = scene::Image<std::uint8_t>{classes.size(), Binning::no_bin};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (scene::is_scored(classes[i])) {
                binning.bin[i] = bin_of(binning, value_of(i));
            }
        }
    });
}

/// Values gathered by bin, in the order of the pixels.
class Gathered {
public:
    /// @param has  whether a pixel has a value.
    template <typename Has, typename ValueOf>
    Gathered(const Binning& binning, const Has& has, const ValueOf& value_of)
        : ends_(static_cast<std::size_t>(binning.bins) + 1)
    {
        const std::size_t pixels = binning.bin.pixel_count();
        for (std::size_t i = 0; i < pixels; ++i) {
            if (has(i)) {
                ++ends_[binning.bin[i] + std::size_t{1}];
            }
        }
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        values_.resize(ends_.back());
        std::vector<std::size_t> next{ends_.begin(), ends_.end() - 1};
        for (std::size_t i = 0; i < pixels; ++i) {
            if (has(i)) {
                values_[next[binning.bin[i]]++] = value_of(i);
            }
        }
    }

    [[nodiscard]] std::optional<Quantiles> quantiles(std::size_t bin)
    {
        return find_quantiles(std::span{values_}.subspan(ends_[bin], ends_[bin + 1] - ends_[bin]));
    }

private:
    std::vector<std::size_t> ends_; ///< where each bin's values begin, and the last one's end
    std::vector<float> values_;
};

/// The bins without their counts.
std::vector<ErrorBin> spreads(const Binning& binning, const BreakdownInputs& inputs)
{
    Gathered needed{binning, [&](std::size_t i) { return inputs.classes[i] == PixelClass::lit; },
                    [&](std::size_t i) { return inputs.criticals[i]; }};
    Gathered map_errors_m{binning,
                          [&](std::size_t i) {
                              return !inputs.map_error_m.empty() &&
                                     scene::is_scored(inputs.classes[i]);
                          },
                          [&](std::size_t i) { return inputs.map_error_m[i]; }};
    std::vector<ErrorBin> bins(static_cast<std::size_t>(binning.bins));
    tbb::parallel_for(std::size_t{0}, bins.size(), [&](std::size_t i) {
        bins[i] = {binning.edge(static_cast<int>(i)),
                   binning.edge(static_cast<int>(i) + 1),
                   {},
                   needed.quantiles(i),
                   map_errors_m.quantiles(i)};
    });
    return bins;
}

template <typename IsLit>
void count_bins(const Binning& binning, const scene::Image<PixelClass>& classes,
                const IsLit& is_lit, std::vector<ErrorBin>& bins)
{
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (binning.bin[i] != Binning::no_bin) {
            count_pixel(bins[binning.bin[i]].counts, classes[i], is_lit(i));
        }
    }
}

void require_inputs(const Binning& binning, const BreakdownInputs& inputs)
{
    const scene::ImageSize size = inputs.classes.size();
    for (const scene::ImageSize other :
         {binning.bin.size(), inputs.lookup.samples.size(), inputs.criticals.size(),
          inputs.map_error_m.empty() ? size : inputs.map_error_m.size()}) {
        require_size("errors_by_bin", other, size);
    }
}

} // namespace

std::optional<double> PartCounts::false_shadow_rate() const
{
    return ratio(false_shadow, lit);
}

std::optional<double> PartCounts::false_lit_rate() const
{
    return ratio(false_lit, blocked);
}

std::optional<double> PartCounts::error_rate() const
{
    return ratio(false_shadow + false_lit, lit + blocked);
}

double Binning::edge(int i) const
{
    return std::lerp(lower, upper, static_cast<double>(i) / bins);
}

Binning bin_by_distance(const scene::Image<PixelClass>& classes, const scene::Image<float>& zeta_m,
                        int bins)
{
    require_bins("bin_by_distance", bins);
    require_size("bin_by_distance", zeta_m.size(), classes.size());
    const Range range = scored_range(classes, zeta_m);
    Binning binning;
    if (range.lower <= range.upper) {
        binning.lower = range.lower;
        binning.upper = range.upper;
        binning.bins = range.lower < range.upper ? bins : 1;
    }
    fill(binning, classes, [&](std::size_t i) { return double{zeta_m[i]}; });
    return binning;
}

Binning bin_by_angle(const scene::Image<PixelClass>& classes, const scene::LookupLayers& lookup,
                     int bins)
{
    require_bins("bin_by_angle", bins);
    require_size("bin_by_angle", lookup.samples.size(), classes.size());
    Binning binning;
    binning.upper = std::numbers::pi / 2;
    binning.bins = bins;
    fill(binning, classes,
         [&](std::size_t i) { return std::atan(double{lookup.samples[i].tan_theta}); });
    return binning;
}

std::vector<std::vector<ErrorBin>>
errors_by_bin(const Binning& binning, const BreakdownInputs& inputs, std::span<const float> biases)
{
    require_inputs(binning, inputs);
    const std::vector<ErrorBin> empty = spreads(binning, inputs);
    std::vector<std::vector<ErrorBin>> result;
    for (const float bias : biases) {
        count_bins(
            binning, inputs.classes, [&](std::size_t i) { return inputs.criticals[i] <= bias; },
            result.emplace_back(empty));
    }
    return result;
}

std::vector<ErrorBin> errors_by_bin(const Binning& binning, const BreakdownInputs& inputs)
{
    require_inputs(binning, inputs);
    std::vector<ErrorBin> bins = spreads(binning, inputs);
    count_bins(
        binning, inputs.classes,
        [&](std::size_t i) { return scene::is_lit(inputs.lookup.samples[i].verdict); }, bins);
    return bins;
}

std::vector<ObjectErrors> errors_by_object(const scene::Image<PixelClass>& classes,
                                           const scene::LookupLayers& lookup,
                                           const scene::Image<std::uint32_t>& triangles,
                                           const scene::TriangleScene& scene)
{
    if (lookup.samples.size() != classes.size() || triangles.size() != classes.size()) {
        throw std::invalid_argument("errors_by_object: the images differ in size");
    }
    std::vector<ObjectErrors> errors;
    for (const scene::Object& object : scene.objects) {
        errors.push_back({object.name, {}});
    }
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i])) {
            ObjectErrors& of_object = errors[scene.object_of(triangles[i])];
            count_pixel(of_object.counts, classes[i], scene::is_lit(lookup.samples[i].verdict));
        }
    }
    return errors;
}

} // namespace gnomon::analysis
