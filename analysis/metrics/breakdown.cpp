#include "analysis/metrics/breakdown.hpp"

#include "analysis/depth/depth_error.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/pixels/checks.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

/// Counts a subset of the pixels by verdict.
class CellTally {
public:
    explicit CellTally(int taps) : shadow_{taps}, light_{taps} {}

    void add(const scene::Truth& truth, std::size_t pixel, float verdict)
    {
        const bool is_lit = scene::is_lit(verdict);
        const auto [too_dark, too_bright] = scene::error_of(truth.share(pixel), verdict);
        shadow_.add(too_dark);
        light_.add(too_bright);
        if (scene::is_lit(truth.pixel_class[pixel])) {
            ++counts_.lit;
            counts_.false_shadow += is_lit ? 0 : 1;
        } else {
            ++counts_.blocked;
            counts_.false_lit += is_lit ? 1 : 0;
        }
    }
    [[nodiscard]] SubsetCounts counts() const
    {
        SubsetCounts counts = counts_;
        counts.shadow_amount = shadow_.value();
        counts.light_amount = light_.value();
        return counts;
    }

private:
    SubsetCounts counts_;
    AmountSum shadow_;
    AmountSum light_;
};

SubsetCounts count_verdicts(std::span<const std::uint32_t> pixels, const scene::Truth& truth,
                            const scene::LookupLayers& lookup, int taps)
{
    CellTally tally{equal_steps(truth, taps)};
    for (const std::uint32_t i : pixels) {
        tally.add(truth, i, lookup.samples[i].verdict);
    }
    return tally.counts();
}

/// Values of a bin's pixels.
struct BinValues {
    std::vector<float> lit; ///< critical biases
    std::vector<float> blocked;
    std::vector<float> map_error_m;
};

BinValues gather(const Binning& binning, std::size_t bin, const BreakdownInputs& inputs)
{
    const auto pixels = binning.pixels_of(bin);
    // Has no branches: writes every value to both lists; it stays where the list grows.
    BinValues values{
        std::vector<float>(pixels.size() + 1), std::vector<float>(pixels.size() + 1), {}};
    std::size_t lit = 0;
    std::size_t blocked = 0;
    for (const std::uint32_t i : pixels) {
        values.lit[lit] = inputs.criticals[i];
        values.blocked[blocked] = inputs.criticals[i];
        const std::size_t is_lit = scene::is_lit(inputs.truth.pixel_class[i]) ? 1 : 0;
        lit += is_lit;
        blocked += 1 - is_lit;
    }
    values.lit.resize(lit);
    values.blocked.resize(blocked);
    if (!inputs.map_error_m.empty()) {
        values.map_error_m.resize(pixels.size());
        std::ranges::transform(pixels, values.map_error_m.begin(),
                               [&](std::uint32_t i) { return inputs.map_error_m[i]; });
    }
    return values;
}

SubsetCounts count_at(const BinValues& values, float bias)
{
    const auto is_lit = [&](float critical) { return critical <= bias; };
    const auto count = [&](const std::vector<float>& criticals) {
        return static_cast<std::uint64_t>(std::ranges::count_if(criticals, is_lit));
    };
    const std::uint64_t false_shadow = values.lit.size() - count(values.lit);
    const std::uint64_t false_lit = count(values.blocked);
    return {values.lit.size(),
            values.blocked.size(),
            false_shadow,
            false_lit,
            static_cast<double>(false_shadow),
            static_cast<double>(false_lit)};
}

/// Replaces the amounts by those of the given numbers of lit taps.
void set_amounts(SubsetCounts& counts, std::span<const std::uint32_t> pixels,
                 const BreakdownInputs& inputs, const scene::Image<std::uint8_t>& lit_taps)
{
    std::array<std::uint64_t, 2> lit{}; // index 1 if the truth is lit
    for (const std::uint32_t i : pixels) {
        lit[scene::is_lit(inputs.truth.pixel_class[i]) ? 1 : 0] += lit_taps[i];
    }
    const auto taps = static_cast<std::uint64_t>(inputs.taps);
    counts.shadow_amount =
        static_cast<double>(counts.lit * taps - lit[1]) / static_cast<double>(taps);
    counts.light_amount = static_cast<double>(lit[0]) / static_cast<double>(taps);
}

/// The bin's quantiles, without counts; reorders the values.
ErrorBin measure_spread(const Binning& binning, std::size_t bin, BinValues& values)
{
    return {binning.edge(static_cast<int>(bin)),
            binning.edge(static_cast<int>(bin) + 1),
            {},
            find_quantiles(std::span{values.lit}),
            find_quantiles(std::span{values.map_error_m})};
}

void require_inputs(const Binning& binning, const BreakdownInputs& inputs)
{
    const scene::ImageSize size = inputs.truth.pixel_class.size();
    require_equal_sizes("errors_by_bin", size,
                        {binning.image, inputs.lookup.samples.size(), inputs.criticals.size(),
                         inputs.map_error_m.empty() ? size : inputs.map_error_m.size()});
}

} // namespace

std::vector<std::vector<ErrorBin>>
errors_by_bin(const Binning& binning, const BreakdownInputs& inputs, std::span<const float> biases,
              std::span<const scene::Image<std::uint8_t>> lit_taps)
{
    require_inputs(binning, inputs);
    const auto bins = static_cast<std::size_t>(binning.bins);
    std::vector<std::vector<ErrorBin>> result(biases.size(), std::vector<ErrorBin>(bins));
    tbb::parallel_for(std::size_t{0}, bins, [&](std::size_t bin) {
        BinValues values = gather(binning, bin, inputs);
        const ErrorBin spread = measure_spread(binning, bin, values);
        for (std::size_t i = 0; i < biases.size(); ++i) {
            result[i][bin] = spread;
            result[i][bin].counts = count_at(values, biases[i]);
            if (!lit_taps.empty()) {
                set_amounts(result[i][bin].counts, binning.pixels_of(bin), inputs, lit_taps[i]);
            }
        }
    });
    return result;
}

std::vector<ErrorBin> errors_by_bin(const Binning& binning, const BreakdownInputs& inputs)
{
    require_inputs(binning, inputs);
    std::vector<ErrorBin> bins(static_cast<std::size_t>(binning.bins));
    tbb::parallel_for(std::size_t{0}, bins.size(), [&](std::size_t bin) {
        BinValues values = gather(binning, bin, inputs);
        bins[bin] = measure_spread(binning, bin, values);
        bins[bin].counts =
            count_verdicts(binning.pixels_of(bin), inputs.truth, inputs.lookup, inputs.taps);
    });
    return bins;
}

std::vector<SubsetCounts> count_by_bin(const Binning& binning, const scene::Truth& truth,
                                       const scene::LookupLayers& lookup, int taps)
{
    require_equal_sizes("count_by_bin", truth.pixel_class.size(),
                        {binning.image, lookup.samples.size()});
    std::vector<SubsetCounts> counts(static_cast<std::size_t>(binning.bins));
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        counts[bin] = count_verdicts(binning.pixels_of(bin), truth, lookup, taps);
    }
    return counts;
}

std::vector<ObjectErrors> errors_by_object(const scene::Truth& truth,
                                           const scene::LookupLayers& lookup,
                                           const scene::Image<std::uint32_t>& triangles,
                                           const scene::TriangleScene& scene, int taps)
{
    const scene::Image<PixelClass>& classes = truth.pixel_class;
    require_equal_sizes("errors_by_object", classes.size(),
                        {lookup.samples.size(), triangles.size()});
    std::vector<CellTally> tallies(scene.objects.size(), CellTally{equal_steps(truth, taps)});
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i])) {
            tallies[scene.object_of(triangles[i])].add(truth, i, lookup.samples[i].verdict);
        }
    }
    std::vector<ObjectErrors> errors;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        errors.push_back({scene.objects[i].name, tallies[i].counts()});
    }
    return errors;
}

std::vector<MapErrors> errors_by_map(const MapBreakdownInputs& inputs)
{
    const auto& [truth, lookup, maps, map_count, causes, taps] = inputs;
    const scene::Image<PixelClass>& classes = truth.pixel_class;
    if (map_count < 2) {
        return {};
    }
    require_equal_sizes("errors_by_map", classes.size(),
                        {lookup.samples.size(), maps.size(), causes.cause.size()});
    std::vector<CellTally> tallies(map_count, CellTally{equal_steps(truth, taps)});
    std::vector<MapErrors> errors(map_count);
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        const float verdict = lookup.samples[i].verdict;
        tallies.at(maps[i]).add(truth, i, verdict);
        if (scene::is_lit(verdict) != scene::is_lit(classes[i])) {
            CauseCounts& counts = errors[maps[i]].causes;
            ++counts.by_cause[static_cast<std::size_t>(causes.cause[i])];
            ++counts.by_label[static_cast<std::size_t>(causes.label[i])];
        }
    }
    for (std::size_t map = 0; map < map_count; ++map) {
        errors[map].counts = tallies[map].counts();
    }
    return errors;
}

namespace {

/// The largest error of a map's depths between two light distances.
class Envelope {
public:
    Envelope(const scene::LightFrustum& frustum, scene::DepthFormat format)
        : frustum_{frustum},
          mapping_{frustum.stored_range()},
          coding_{DepthCoding::of(format)},
          corner_{frustum.largest_per_light_distance()}
    {
    }

    [[nodiscard]] double within(double lower_m, double upper_m) const
    {
        const auto inside = [&](double light_distance_m) {
            return std::clamp(light_distance_m, frustum_.near_m, frustum_.far_m);
        };
        const auto [light_distance_m, tolerance] =
            coarsest_depth(mapping_, coding_, inside(lower_m), inside(corner_ * upper_m));
        return mapping_.largest_light_distance_error_m(light_distance_m, tolerance);
    }

private:
    const scene::LightFrustum& frustum_;
    DepthMapping mapping_;
    DepthCoding coding_;
    /// A receiver at ζ is at least ζ from the light, and farther by up to this factor at a map's
    /// corner.
    double corner_;
};

} // namespace

void add_envelopes(std::vector<ErrorBin>& by_distance, std::span<const scene::LightFrustum> maps,
                   scene::DepthFormat format)
{
    for (const scene::LightFrustum& map : maps) {
        const Envelope envelope{map, format};
        for (ErrorBin& bin : by_distance) {
            bin.envelope_m =
                std::max(bin.envelope_m.value_or(0), envelope.within(bin.lower, bin.upper));
        }
    }
}

} // namespace gnomon::analysis
