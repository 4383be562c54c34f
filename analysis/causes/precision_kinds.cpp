#include "analysis/causes/precision_kinds.hpp"

#include "analysis/causes/traced_lookups.hpp"
#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/taps.hpp"
#include "methods/job_method.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The rows of the pixels' taps; at least one row.
scene::TexelRows rows_of(const scene::Job& job, const scene::View& view,
                         const scene::LookupLayers& lookup, std::span<const std::size_t> pixels)
{
    const int resolution = job.shadow_map.resolution_texels;
    const LookupRule rule = lookup_rule(job, view);
    const Footprint footprint{rule.traits, rule.edge(), resolution};
    int first = resolution - 1;
    int last = 0;
    for (const std::size_t pixel : pixels) {
        footprint.visit_taps(lookup.at(pixel), [&](const Tap& tap) {
            if (tap.is_inside) {
                first = std::min(first, tap.texel.y);
                last = std::max(last, tap.texel.y);
            }
        });
    }
    first = std::min(first, last);
    return {first, last - first + 1};
}

scene::Job with_floats(scene::Job job)
{
    job.shadow_map.depth_format = scene::float_depth_format;
    return job;
}

/// Moves the lookup to the receiver itself.
scene::View without_bias(scene::View view)
{
    view.bias = {};
    return view;
}

} // namespace

FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                        const scene::LookupLayers& lookup, std::span<const std::size_t> pixels,
                        const std::shared_ptr<const renderers::Receivers>& receivers,
                        renderers::Rasterizer& rasterizer)
{
    const scene::Job floats = with_floats(job);
    const methods::LookupTraits traits = methods::traits(job);
    if (can_derive_unbiased(job, view) && !traits.interpolates()) {
        // The receivers' positions in the map do not depend on its format.
        const renderers::MapRequest rows{.rows = rows_of(job, view, lookup, pixels)};
        return {{}, rasterizer.draw_map(floats, view, rows)->depths()};
    }
    const scene::View unbiased = without_bias(view);
    const renderers::Drawn drawn{receivers,
                                 renderers::draw_filtered_map(rasterizer, floats, unbiased)};
    FloatMap map{rasterizer.look_up({drawn, floats, unbiased}), {}};
    if (traits.has_fractions() || traits.has_one_tap()) {
        map.depths = drawn.map->map().depths();
    }
    return map;
}

FloatLookups look_up_floats(const scene::Job& job, const scene::View& view,
                            const std::shared_ptr<const renderers::Receivers>& receivers,
                            renderers::Rasterizer& rasterizer)
{
    const scene::Job floats = with_floats(job);
    const auto look_up = [&](const scene::View& biased) {
        const renderers::Drawn drawn{
            receivers, renderers::draw_filtered_map(rasterizer, floats, biased,
                                                    renderers::FilteredContent::float32)};
        return rasterizer.look_up({drawn, floats, biased});
    };
    scene::LookupLayers biased = look_up(view);
    return {std::move(biased), look_up(without_bias(view))};
}

namespace {

class FloatVerdicts {
public:
    FloatVerdicts(const CauseInputs& floats, const scene::Bias& bias)
        : floats_{floats},
          footprint_{floats.footprint()},
          rule_{floats.rule},
          bias_{bias}
    {
    }

    /// Whether the pixel's only comparison is right.
    [[nodiscard]] bool repairs(std::size_t pixel) const
    {
        if (keeps_terms(pixel)) {
            return repairs_with_terms(pixel);
        }
        const float r = floats_.unbiased.samples[pixel].receiver_depth;
        return rule_.is_lit(r, compared_depth(pixel), kept_bias(pixel)) == is_lit_truth(pixel);
    }

    /// Whether its taps' verdict is on the right side of one half.
    /// @param own  Taps that count as lit.
    [[nodiscard]] bool repairs(std::size_t pixel, std::span<const Tap> taps,
                               const TapSet& own) const
    {
        if (keeps_terms(pixel)) {
            return repairs_with_terms(pixel);
        }
        const float r = floats_.unbiased.samples[pixel].receiver_depth;
        double lit = 0;
        double all = 0;
        for (std::size_t t = 0; t < taps.size(); ++t) {
            const float depth = taps[t].is_inside ? depth_at(taps[t].texel) : rule_.outside_depth();
            all += taps[t].weight;
            lit += own[t] || rule_.is_lit(r, depth, kept_bias(pixel)) ? taps[t].weight : 0;
        }
        return (lit >= 0.5 * all) == is_lit_truth(pixel);
    }

    [[nodiscard]] bool is_lit_truth(std::size_t pixel) const
    {
        return scene::is_lit(floats_.truth.pixel_class[pixel]);
    }

private:
    [[nodiscard]] bool keeps_terms(std::size_t pixel) const
    {
        return floats_.terms != nullptr && is_lit_truth(pixel);
    }
    /// Whether enough of a lit pixel's weight is lit, with the job's terms.
    [[nodiscard]] bool repairs_with_terms(std::size_t pixel) const
    {
        const scene::MapPoint at = floats_.job.at(pixel);
        const scene::Texel first = footprint_.first_tap(at);
        const int width = footprint_.width_texels();
        int next = 0;
        double lit = 0;
        double all = 0;
        footprint_.visit_taps(at, [&](const Tap& tap) {
            const int row = next / width;
            const scene::Vec2f centre{static_cast<float>(first.x + next % width) + 0.5F,
                                      static_cast<float>(first.y + row) + 0.5F};
            const float r = floats_.job.samples[pixel].receiver_depth +
                            floats_.terms->rise(pixel, centre, at.texel);
            all += tap.weight;
            lit += rule_.is_lit(r, offset_depth(tap), kept_bias(pixel)) ? tap.weight : 0;
            ++next;
        });
        return lit >= 0.5 * all;
    }
    /// The depth of the tap's texel with the map's offset.
    [[nodiscard]] float offset_depth(const Tap& tap) const
    {
        if (!tap.is_inside) {
            return rule_.outside_depth();
        }
        const double depth{depth_at(tap.texel)};
        const double offset =
            floats_.terms->offsets ? floats_.terms->offsets->at(tap.texel, depth) : 0;
        return static_cast<float>(depth + offset);
    }
    [[nodiscard]] float depth_at(const scene::Texel& texel) const
    {
        return at_texel(floats_.map_depths, texel);
    }
    /// The depth of the only tap, or as GL interpolated it.
    [[nodiscard]] float compared_depth(std::size_t pixel) const
    {
        const float looked_up = floats_.unbiased.samples[pixel].map_depth;
        if (!floats_.rule.traits.has_one_tap()) {
            return looked_up;
        }
        const Tap tap = footprint_.taps(floats_.unbiased.at(pixel)).front();
        return tap.is_inside ? depth_at(tap.texel) : looked_up;
    }
    /// V2's bias: for a lit pixel the job's, as its lookup added it.
    [[nodiscard]] float kept_bias(std::size_t pixel) const
    {
        const float slope_term = bias_.slope * floats_.job.samples[pixel].tan_theta;
        const float constant =
            bias_.constant * rule_.bias_scale(scene::map_of(floats_.job.maps, pixel));
        return is_lit_truth(pixel) ? constant + slope_term : 0;
    }

    const CauseInputs& floats_;
    Footprint footprint_;
    LookupRule rule_;
    scene::Bias bias_;
};

} // namespace

std::vector<std::size_t> wrong_by_precision(const scene::Image<Cause>& causes,
                                            const scene::Truth& truth,
                                            const scene::LookupLayers& lookup)
{
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < causes.pixel_count(); ++i) {
        const bool is_lit_truth = scene::is_lit(truth.pixel_class[i]);
        if (causes[i] == Cause::precision &&
            scene::is_lit(lookup.samples[i].verdict) != is_lit_truth) {
            pixels.push_back(i);
        }
    }
    return pixels;
}

PrecisionKinds find_precision_kinds(const CauseInputs& floats, std::span<const std::size_t> pixels,
                                    const scene::Bias& bias)
{
    const FloatVerdicts map{floats, bias};
    PrecisionKinds kinds;
    const auto add = [&](bool is_repaired) { ++(is_repaired ? kinds.format : kinds.transform); };
    if (!floats.rule.traits.has_fractions()) {
        for (const std::size_t pixel : pixels) {
            add(map.repairs(pixel));
        }
        return kinds;
    }
    const TracedLookups lookups = trace_lookups(floats, floats.unbiased, pixels);
    std::vector<TapSet> asked(
        lookups.size()); // of blocked pixels, whose self-shadowing taps count as lit
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        asked[i] = map.is_lit_truth(lookups.pixel(i)) ? TapSet{} : TapSet{}.set();
    }
    const auto own = own_taps(floats.light, lookups, asked);
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        add(map.repairs(lookups.pixel(i), lookups.taps_of(i), own[i]));
    }
    return kinds;
}

PrecisionKinds find_precision_kinds(const scene::Truth& truth, const scene::LookupLayers& biased,
                                    const scene::LookupLayers& unbiased,
                                    std::span<const std::size_t> pixels)
{
    PrecisionKinds kinds;
    for (const std::size_t pixel : pixels) {
        const bool is_lit = scene::is_lit(truth.pixel_class[pixel]);
        const float verdict = (is_lit ? biased : unbiased).samples[pixel].verdict;
        ++(scene::is_lit(verdict) == is_lit ? kinds.format : kinds.transform);
    }
    return kinds;
}

} // namespace gnomon::analysis
