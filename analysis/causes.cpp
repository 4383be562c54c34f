#include "analysis/causes.hpp"

#include "analysis/exact_lookup.hpp"
#include "analysis/footprint.hpp"
#include "analysis/own_sheets.hpp"
#include "analysis/texel_hits.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::analysis {

using scene::Outside;
using scene::PixelClass;

namespace {

/// Taps that a thread holds: bounds the memory, whatever the image and filter; neighbouring pixels
/// share texels, so that it should not be too few.
constexpr std::size_t taps_at_once = std::size_t{1} << 18U;

class CauseFinder {
public:
    explicit CauseFinder(const CauseInputs& inputs)
        : inputs_{inputs},
          rules_{inputs.rules()},
          footprint_{inputs.lookup, inputs.resolution_texels},
          causes_{inputs.truth.pixel_class.size()}
    {
    }

    scene::Image<PixelCause> find()
    {
        const std::size_t at_once = std::max<std::size_t>(1, taps_at_once / footprint_.tap_count());
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>{0, causes_.pixel_count(), at_once},
            [&](const tbb::blocked_range<std::size_t>& run) {
                Lookups lit{{}, {}, footprint_.tap_count()};
                Lookups blocked{{}, {}, footprint_.tap_count()};
                for (std::size_t pixel = run.begin(); pixel != run.end(); ++pixel) {
                    collect(pixel, lit, blocked);
                }
                explain_lit({std::move(lit), inputs_.light});
                explain_blocked({std::move(blocked), inputs_.light});
            },
            tbb::simple_partitioner{});
        return std::move(causes_);
    }

private:
    /// Keeps the pixel when the map is wrong about it without any bias.
    void collect(std::size_t pixel, Lookups& lit, Lookups& blocked)
    {
        const PixelClass truth = inputs_.truth.pixel_class[pixel];
        const scene::LookupSample& sample = inputs_.unbiased.samples[pixel];
        if (!scene::is_scored(truth) ||
            scene::is_lit(sample.verdict) == (truth == PixelClass::lit)) {
            return;
        }
        Lookups& lookups = truth == PixelClass::lit ? lit : blocked;
        const std::size_t before = lookups.taps.size();
        footprint_.append_taps(inputs_.unbiased.texels[pixel], lookups.taps);
        if (rules_.is_policy(sample.receiver_depth, std::span{lookups.taps}.subspan(before))) {
            causes_[pixel] = {Cause::coverage, false, std::numeric_limits<float>::infinity()};
            lookups.taps.resize(before);
            return;
        }
        lookups.pixels.push_back(pixel);
    }

    void explain_lit(const TracedLookups& lookups)
    {
        const auto critical = exact_critical_biases(rules_, lookups, inputs_.light);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            const std::size_t pixel = lookups.pixel(i);
            // V3: nothing crosses the segment, so only a policy can shadow.
            const bool is_lit = !is_uncovered(pixel) || inputs_.lookup.outside == Outside::lit;
            causes_[pixel] = {is_lit ? Cause::resolution : Cause::coverage, false, critical[i]};
        }
        const auto own = sees_own_sheets(inputs_, lookups);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            causes_[lookups.pixel(i)].sees = own[i];
        }
    }

    /// True where an infinitely fine map has nothing to say of P.
    [[nodiscard]] bool is_uncovered(std::size_t pixel) const
    {
        return !footprint_.is_inside(inputs_.unbiased.texels[pixel]) ||
               rules_.is_beyond_far(inputs_.unbiased.samples[pixel].receiver_depth);
    }

    void explain_blocked(const TracedLookups& lookups)
    {
        const auto critical = exact_critical_biases(rules_, lookups, inputs_.light);
        std::vector<std::size_t> lost; // exact depths do not help
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            if (critical[i] > 0) {
                causes_[lookups.pixel(i)].unbiased = Cause::precision;
            } else {
                lost.push_back(lookups.pixel(i));
            }
        }
        const auto crossed = inputs_.light.are_crossed(lost);
        std::vector<std::size_t> between_texels;
        for (std::size_t i = 0; i < lost.size(); ++i) {
            const bool is_shadowed = is_uncovered(lost[i])
                                         ? inputs_.lookup.outside == Outside::shadowed
                                         : crossed[i] != 0;
            causes_[lost[i]].unbiased = is_shadowed ? Cause::resolution : Cause::coverage;
            if (is_shadowed) {
                between_texels.push_back(lost[i]);
            }
        }
        look_around(between_texels);
    }

    /// `sees`: some texel around the taps sees the blocker, or anything as near to the light.
    void look_around(std::span<const std::size_t> pixels)
    {
        std::vector<scene::Texel> texels;
        std::vector<std::size_t> ends;
        for (const std::size_t pixel : pixels) {
            const auto ring = footprint_.ring(inputs_.unbiased.texels[pixel]);
            texels.insert(texels.end(), ring.begin(), ring.end());
            ends.push_back(texels.size());
        }
        const TexelHits hits{inputs_.light, texels};
        const auto blockers = inputs_.light.find_blockers(pixels);
        std::size_t next = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double middle_m = 0.5 * (blockers[i].zeta_m + blockers[i].receiver_zeta_m);
            for (; next < ends[i]; ++next) {
                causes_[pixels[i]].sees |= hits[texels[next]].zeta_m < middle_m;
            }
        }
    }

    const CauseInputs& inputs_;
    TapRules rules_;
    Footprint footprint_;
    scene::Image<PixelCause> causes_;
};

void require_sizes(const CauseInputs& inputs)
{
    const scene::ImageSize size = inputs.truth.pixel_class.size();
    if (inputs.unbiased.samples.size() != size || inputs.unbiased.texels.size() != size) {
        throw std::invalid_argument("find_causes: the lookup is not of the truth's size");
    }
    const scene::ImageSize map{inputs.resolution_texels, inputs.resolution_texels};
    if (inputs.lookup.filter != scene::Filter::nearest && inputs.map_depths.size() != map) {
        throw std::invalid_argument("find_causes: map_depths is not of the map's size");
    }
}

} // namespace

scene::Image<PixelCause> find_causes(const CauseInputs& inputs)
{
    require_sizes(inputs);
    return CauseFinder{inputs}.find();
}

Cause cause_of(const PixelCause& pixel, PixelClass truth, float bias)
{
    if (pixel.unbiased == Cause::none) {
        return Cause::bias;
    }
    const bool is_repaired_by_exact_depths =
        truth == PixelClass::lit && bias >= pixel.exact_critical_bias;
    return is_repaired_by_exact_depths ? Cause::precision : pixel.unbiased;
}

Label label_of(const PixelCause& pixel, PixelClass truth, Cause cause)
{
    if (truth == PixelClass::lit) {
        const bool is_by_map = cause == Cause::precision || cause == Cause::resolution;
        return !is_by_map ? Label::overshadow : (pixel.sees ? Label::acne : Label::edge);
    }
    if (cause == Cause::bias) {
        return Label::peter_panning;
    }
    return cause == Cause::resolution && pixel.sees ? Label::edge : Label::leak;
}

CauseLayers classify_errors(const scene::TruthLayers& truth, const scene::LookupLayers& lookup,
                            const scene::Image<PixelCause>& pixels, const scene::Bias& bias)
{
    CauseLayers layers{scene::Image<Cause>{truth.pixel_class.size()},
                       scene::Image<Label>{truth.pixel_class.size()},
                       {}};
    for (std::size_t i = 0; i < pixels.pixel_count(); ++i) {
        const PixelClass pixel_class = truth.pixel_class[i];
        const scene::LookupSample& sample = lookup.samples[i];
        if (!scene::is_scored(pixel_class) ||
            scene::is_lit(sample.verdict) == (pixel_class == PixelClass::lit)) {
            continue;
        }
        const float slope_term = bias.slope * sample.tan_theta;
        layers.cause[i] = cause_of(pixels[i], pixel_class, bias.constant + slope_term);
        layers.label[i] = label_of(pixels[i], pixel_class, layers.cause[i]);
        ++layers.counts.by_cause[static_cast<std::size_t>(layers.cause[i])];
        ++layers.counts.by_label[static_cast<std::size_t>(layers.label[i])];
    }
    return layers;
}

} // namespace gnomon::analysis
