#pragma once

#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "methods/lookup_traits.hpp"
#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The stored depths that a lookup reads, as raster_gl/shaders/lookup.frag does.
class StoredTaps {
public:
    /// @param map_depths  As shaders see them (`scene::maps_image_size`); must outlive this.
    StoredTaps(const scene::Image<float>& map_depths, const LookupRule& rule);

    /// Writes the depths of the footprint to `out`; a tap outside the map has the rule's
    /// `outside_depth`.
    /// @param at   Where the lookup reads.
    /// @param out  One element for each tap.
    /// @return  The depths written; empty where the border mode decides for all taps, beyond far or
    ///          behind a spot.
    [[nodiscard]] std::span<float> gather(const scene::LookupSample& sample,
                                          const scene::MapPoint& at, std::span<float> out) const;

private:
    [[nodiscard]] bool border_decides_all(const scene::LookupSample& sample,
                                          const scene::MapPoint& at) const;

    const scene::Image<float>& map_depths_;
    LookupRule rule_;
    Footprint footprint_;
};

/// Compares each tap of a lookup separately: it has its own critical bias, from which on it is lit.
class TapCriticals {
public:
    /// @param lookup      With its texels.
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
    /// Calls `visit(pixel, criticals)` for the pixels in [first, last) for which `wants(pixel)`.
    /// Passes the critical biases of the pixel's taps in the order of the footprint; where the
    /// border mode decides, its critical bias.
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
    /// Sets the comparisons of a pixel's taps, starting at place `at`.
    void fill(std::size_t pixel, std::size_t at, ComparisonBlock& block) const
    {
        const scene::LookupSample& sample = lookup_.samples[pixel];
        std::array<float, methods::most_taps> depths; // filled as far as it is read
        const auto read = taps_.gather(sample, lookup_.at(pixel), depths);
        const float slope_term = rule_.slope * sample.tan_theta;
        for (std::size_t t = 0; t < taps_each_; ++t) {
            if (read.empty()) { // any receiver depth will do; a spot's may be NaN
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

/// The comparison that decides each pixel's verdict: the lookup's samples, with `map_depth`
/// replaced by the depth of the deciding tap; NaN where the border mode decides.
///
/// nearest and linear make one comparison, so their samples are returned unchanged. pcfK makes n =
/// K² comparisons (or one for each tap of a kernel) and is lit if at least ⌈n/2⌉ of them are. The
/// critical bias is monotone in the map depth, so the tap of median depth decides. Of two medians,
/// it is the one at which half of the taps are lit. A tap outside the map counts as farther
/// (`outside` lit) or nearer (shadowed) than every depth. The result depends on no bias of the
/// curve's formula.
/// @param where       The same lookup: its texels and maps.
/// @param map_depths  As shaders see them (`scene::maps_image_size`). Like `where`, not read if
///                    there is one comparison.
/// @throws std::invalid_argument  if the filter has no formula; if the images differ in size; if
///                                the maps are not square.
/// Source: raster_gl/shaders/lookup.frag; docs/bias_curve.md#critical-bias.
[[nodiscard]] scene::LookupLayers deciding_samples(scene::LookupLayers lookup,
                                                   const scene::LookupLayers& where,
                                                   const scene::Image<float>& map_depths,
                                                   const LookupRule& rule);

/// Whether the unbiased lookup follows from the biased one: it reads at the receiver itself, and
/// each verdict has a deciding tap.
[[nodiscard]] bool can_derive_unbiased(const scene::Job& job, const scene::View& view);

} // namespace gnomon::analysis
