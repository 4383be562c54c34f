#pragma once

#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/stored_taps.hpp"
#include "methods/lookup_traits.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The taps of lookups, each compared by itself, with its own critical bias: at a bias, those whose
/// critical bias is not above it are lit.
class TapCriticals {
public:
    /// @param lookup      with its texels.
    /// @param map_depths  As shaders see them (`scene::maps_image_size`).
    /// Both must outlive this.
    TapCriticals(const scene::LookupLayers& lookup, const scene::Image<float>& map_depths,
                 const LookupRule& rule)
        : lookup_{lookup},
          taps_{map_depths, rule},
          rule_{rule},
          footprint_{rule.traits, rule.edge(), map_depths.size().width_px},
          taps_each_{rule.traits.tap_count()}
    {
    }

    [[nodiscard]] std::size_t taps_each() const { return taps_each_; }
    /// Writes the weights of the pixel's taps, in the order of the footprint.
    void weights(std::size_t pixel, std::span<double> out) const
    {
        auto next = out.begin();
        footprint_.visit_taps(lookup_.at(pixel), [&](const Tap& tap) { *next++ = tap.weight; });
    }
    /// Calls `visit(pixel, criticals)` for the pixels in [first, last) that `wants(pixel)`, with
    /// the critical biases of the pixel's taps, in the order of the footprint. Those that the
    /// border mode decides have its critical bias.
    template <typename Wants, typename Visit>
    void visit(std::size_t first, std::size_t last, const Wants& wants, const Visit& visit) const
    {
        std::array<std::size_t, ComparisonBlock::size> pixels; // filled as far as it is read
        ComparisonBlock block;
        const std::size_t pixels_at_once = ComparisonBlock::size / taps_each_;
        std::size_t count = 0;
        const auto flush = [&] {
            const auto criticals = block.solve(count * taps_each_);
            for (std::size_t i = 0; i < count; ++i) {
                const auto of_taps = criticals.subspan(i * taps_each_, taps_each_);
                const float scale = rule_.bias_scale(scene::map_of(lookup_.maps, pixels[i]));
                if (scale == 1) {
                    visit(pixels[i], of_taps);
                    continue;
                }
                std::array<float, methods::most_taps> unscaled; // filled as far as it is read
                std::ranges::transform(of_taps, unscaled.begin(), [&](float critical) {
                    return unscaled_bias(critical, scale);
                });
                visit(pixels[i], std::span<const float>{unscaled}.first(taps_each_));
            }
            count = 0;
        };
        for (std::size_t pixel = first; pixel != last; ++pixel) {
            if (!wants(pixel)) {
                continue;
            }
            fill(pixel, count * taps_each_, block);
            pixels[count++] = pixel;
            if (count == pixels_at_once) {
                flush();
            }
        }
        flush();
    }

private:
    /// Sets the comparisons of a pixel's taps, from the place `at` on.
    void fill(std::size_t pixel, std::size_t at, ComparisonBlock& block) const
    {
        const scene::LookupSample& sample = lookup_.samples[pixel];
        std::array<float, methods::most_taps> depths; // filled as far as it is read
        const auto read = taps_.gather(sample, lookup_.at(pixel), depths);
        const float slope_term = rule_.slope * sample.tan_theta;
        for (std::size_t t = 0; t < taps_each_; ++t) {
            if (read.empty()) { // any receiver depth does, but a spot's may be NaN
                block.set(at + t,
                          OneWayComparison::of(0, rule_.outside_depth(), 0, rule_.reversed));
            } else {
                block.set(at + t, OneWayComparison::of(sample.receiver_depth, read[t], slope_term,
                                                       rule_.reversed));
            }
        }
    }

    const scene::LookupLayers& lookup_;
    StoredTaps taps_;
    LookupRule rule_;
    Footprint footprint_;
    std::size_t taps_each_;
};

} // namespace gnomon::analysis
