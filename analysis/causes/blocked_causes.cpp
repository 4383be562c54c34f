#include "analysis/causes/find_causes.hpp"

#include "analysis/causes/pixel_squares.hpp"
#include "analysis/causes/traced_lookups.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/texel_hits.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

using scene::Outside;

namespace {

/// Whether a repair brings a pixel to the right side of one half, and within 1/256 of the truth.
struct Repair {
    bool of_wrong = false;
    bool of_partial = false;
};

class BlockedCauses {
public:
    BlockedCauses(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                  PixelCauses& causes, CauseCache* cache)
        : inputs_{inputs},
          wanted_{wanted},
          causes_{causes},
          cache_{cache},
          rule_{inputs.rule},
          footprint_{inputs.footprint()},
          is_made_of_taps_{inputs.rule.traits.is_made_of_taps()}
    {
    }

    void find()
    {
        explain_in_squares(
            causes_.pixels.size(), footprint_.tap_count(),
            [&](std::size_t pixel) { return wanted_[pixel] != 0 && !recall(pixel); },
            [&](std::span<const std::size_t> pixels) { explain(pixels); });
    }

private:
    [[nodiscard]] bool is_lit_unbiased(std::size_t pixel) const
    {
        return scene::is_lit(inputs_.unbiased.samples[pixel].verdict);
    }

    /// Uses what the cache knows of the pixel; false if that is not enough.
    [[nodiscard]] bool recall(std::size_t pixel) const
    {
        if (cache_ == nullptr) {
            return false;
        }
        const auto own = cache_->own(pixel);
        if (own && !*own && !is_lit_unbiased(pixel)) {
            causes_.pixels[pixel] = {};
            return true;
        }
        causes_.pixels[pixel] = cache_->known(pixel);
        return cache_->knows(pixel);
    }

    void explain(std::span<const std::size_t> pixels)
    {
        std::vector<std::size_t> open;
        std::vector<Tap> taps;
        for (const std::size_t pixel : pixels) {
            taps.clear();
            footprint_.append_taps(inputs_.unbiased.at(pixel), taps);
            if (!rule_.border_decides(inputs_.unbiased.samples[pixel].receiver_depth, taps)) {
                open.push_back(pixel);
                continue;
            }
            if (rule_.outside == Outside::lit) {
                set(pixel, Cause::coverage);
            }
            remember(pixel, false);
        }
        explain_by_stored_depths(open);
    }

    void set(std::size_t pixel, Cause cause)
    {
        causes_.pixels[pixel].if_wrong = cause;
        causes_.pixels[pixel].if_partial = cause;
    }
    void remember(std::size_t pixel, bool own)
    {
        if (cache_ == nullptr) {
            return;
        }
        cache_->remember_own(pixel, own);
        if (!causes_.pixels[pixel].is_of_bias_alone()) {
            cache_->remember(pixel, causes_.pixels[pixel]);
        }
    }

    /// Applies V1, and then what follows where V1 does not repair.
    void explain_by_stored_depths(std::span<const std::size_t> pixels)
    {
        const TracedLookups lookups = trace_lookups(inputs_, inputs_.unbiased, pixels);
        auto asked = shadowing_taps(inputs_, inputs_.unbiased, lookups);
        for (std::size_t i = 0; i < pixels.size() && !is_made_of_taps_; ++i) {
            asked[i].set(footprint_.centre_tap(inputs_.unbiased.at(pixels[i])));
        }
        const auto own = own_taps(inputs_.light, lookups, asked);
        Open open;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const Repair by_v1 = repair_by_v1(lookups, i, own[i]);
            if (by_v1.of_wrong && by_v1.of_partial) {
                remember(pixels[i], false);
            } else {
                open.pixels.push_back(pixels[i]);
                open.by_bias.push_back(by_v1);
                open.own.push_back(own[i]);
                open.not_asked.push_back(~asked[i]);
            }
        }
        explain_by_exact_depths(std::move(open));
    }

    [[nodiscard]] Repair repair_by_v1(const TracedLookups& lookups, std::size_t i,
                                      const TapSet& own) const
    {
        const std::size_t pixel = lookups.pixel(i);
        double lit{inputs_.unbiased.samples[pixel].verdict};
        if (!is_made_of_taps_) {
            const bool accepts = !sees_own_at_centre(pixel, own);
            return {accepts && lit < 0.5, accepts && lit <= partial_above};
        }
        const auto taps = lookups.taps_of(i);
        double own_weight = 0;
        double weight = 0;
        for (std::size_t t = 0; t < taps.size(); ++t) {
            weight += taps[t].weight;
            own_weight += own[t] ? taps[t].weight : 0;
        }
        lit += own_weight / weight;
        return {lit < 0.5, lit <= partial_above};
    }
    [[nodiscard]] bool sees_own_at_centre(std::size_t pixel, const TapSet& own) const
    {
        return own[footprint_.centre_tap(inputs_.unbiased.at(pixel))];
    }

    /// The pixels that V1 does not repair.
    struct Open {
        std::vector<std::size_t> pixels;
        std::vector<Repair> by_bias;
        std::vector<TapSet> own;       ///< of the taps that were tested
        std::vector<TapSet> not_asked; ///< the taps that were not tested
    };

    void explain_by_exact_depths(Open open)
    {
        const TracedLookups lookups = trace_lookups(inputs_, inputs_.unbiased, open.pixels);
        const auto others = own_taps(inputs_.light, lookups, open.not_asked);
        for (std::size_t i = 0; i < open.own.size(); ++i) {
            open.own[i] |= others[i];
        }
        auto by_v2 = repairs_by_v2(lookups, open.own);
        add_displaced(open.pixels, by_v2);
        const auto by_filter = repairs_by_centre(lookups, open.own);
        std::vector<std::size_t> lost; // pixels that no texel helps
        std::vector<std::size_t> lost_place;
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            const std::size_t pixel = lookups.pixel(i);
            const Cause beyond = by_filter[i] ? Cause::filter : Cause::coverage;
            const auto cause = [&](bool by_bias, bool by_exact) {
                return by_bias ? Cause::none : (by_exact ? Cause::precision : beyond);
            };
            causes_.pixels[pixel].if_wrong = cause(open.by_bias[i].of_wrong, by_v2[i].of_wrong);
            causes_.pixels[pixel].if_partial =
                cause(open.by_bias[i].of_partial, by_v2[i].of_partial);
            if (causes_.pixels[pixel].if_wrong == Cause::coverage ||
                causes_.pixels[pixel].if_partial == Cause::coverage) {
                lost.push_back(pixel);
                lost_place.push_back(i);
            }
        }
        explain_by_truth(lookups, open.own, lost, lost_place);
        find_bleeding(lookups, open.own);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            remember(lookups.pixel(i), open.own[i].any());
        }
    }

    /// Adds V2 at the exact positions, where these read other taps.
    void add_displaced(std::span<const std::size_t> pixels, std::vector<Repair>& by_v2) const
    {
        if (inputs_.exact_reruns != nullptr) {
            return;
        }
        const DisplacedLookups displaced =
            find_displaced(inputs_, inputs_.unbiased, pixels, nullptr);
        for (const std::size_t i : displaced.of_border) {
            const bool is_shadowed = rule_.outside == Outside::shadowed;
            by_v2[i] = {by_v2[i].of_wrong || is_shadowed, by_v2[i].of_partial || is_shadowed};
        }
        if (displaced.pixels.empty()) {
            return;
        }
        const TracedLookups exact = trace_lookups(inputs_, displaced.points, displaced.pixels);
        const std::vector<TapSet> all(exact.size(), TapSet{}.set());
        const auto own = own_taps(inputs_.light, exact, all);
        const auto repairs = repairs_by_v2(exact, own);
        for (std::size_t i = 0; i < repairs.size(); ++i) {
            Repair& either = by_v2[displaced.indices[i]];
            either = {either.of_wrong || repairs[i].of_wrong,
                      either.of_partial || repairs[i].of_partial};
        }
    }

    [[nodiscard]] std::vector<Repair> repairs_by_v2(const TracedLookups& lookups,
                                                    std::span<const TapSet> own) const
    {
        const auto half = exact_biases(lookups, LitShare::half, own);
        const auto any =
            rule_.traits.has_fractions() ? exact_biases(lookups, LitShare::any, own) : half;
        std::vector<Repair> repairs;
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            const bool accepts = is_made_of_taps_ || !own[i][footprint_.centre_tap(lookups.at(i))];
            repairs.push_back({accepts && half[i] > 0, accepts && any[i] > 0});
        }
        return repairs;
    }

    [[nodiscard]] std::vector<float> exact_biases(const TracedLookups& lookups, LitShare share,
                                                  std::span<const TapSet> own) const
    {
        return inputs_.exact_reruns == nullptr
                   ? exact_critical_biases({rule_, inputs_.light, nullptr, own}, lookups, share)
                   : rerun_biases(*inputs_.exact_reruns, lookups, share);
    }

    /// Whether V2n repairs each pixel.
    [[nodiscard]] std::vector<bool> repairs_by_centre(const TracedLookups& lookups,
                                                      std::span<const TapSet> own) const
    {
        std::vector<bool> repairs(lookups.size(), false);
        if (inputs_.rule.traits.has_one_tap()) {
            return repairs; // V2 already tested that
        }
        std::vector<std::size_t> centres;
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            centres.push_back(footprint_.centre_tap(inputs_.unbiased.at(lookups.pixel(i))));
        }
        const auto critical = exact_tap_biases({rule_, inputs_.light}, lookups, centres);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            repairs[i] = critical[i] > 0 && !own[i][centres[i]];
        }
        return repairs;
    }

    /// Sets `sees` where the cause is `filter` though every texel of the footprint shadows by
    /// itself, as in V2: only the method's formula lets light through.
    void find_bleeding(const TracedLookups& lookups, std::span<const TapSet> own)
    {
        if (rule_.traits.compares_depths()) {
            return; // if every texel shadows, so does a mean of depths or any weighting
        }
        std::vector<bool> bleeds(lookups.size());
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            const PixelCause& why = causes_.pixels[lookups.pixel(i)];
            const bool is_by_filter =
                why.if_wrong == Cause::filter || why.if_partial == Cause::filter;
            bleeds[i] = is_by_filter && own[i].none();
        }
        for (std::size_t tap = 0; tap < footprint_.tap_count(); ++tap) {
            const std::vector<std::size_t> of_each(lookups.size(), tap);
            const auto critical = exact_tap_biases({rule_, inputs_.light}, lookups, of_each);
            for (std::size_t i = 0; i < lookups.size(); ++i) {
                bleeds[i] = bleeds[i] && critical[i] > 0;
            }
        }
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            causes_.pixels[lookups.pixel(i)].sees |= bleeds[i];
        }
    }

    /// Applies V3 and V4.
    /// @param indices  Of the pixels, among the lookups.
    void explain_by_truth(const TracedLookups& lookups, std::span<const TapSet> own,
                          std::span<const std::size_t> pixels, std::span<const std::size_t> indices)
    {
        const auto crossed = inputs_.light.occluded(pixels, inputs_.unbiased.maps);
        std::vector<std::size_t> between_texels;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const bool is_shadowed = inputs_.is_uncovered(footprint_, pixels[i])
                                         ? rule_.outside == Outside::shadowed
                                         : crossed[i] != 0;
            if (is_shadowed) {
                PixelCause& pixel = causes_.pixels[pixels[i]];
                for (Cause* cause : {&pixel.if_wrong, &pixel.if_partial}) {
                    *cause = *cause == Cause::coverage ? Cause::resolution : *cause;
                }
                between_texels.push_back(indices[i]);
            }
        }
        look_around(lookups, own, between_texels);
    }

    /// Sets `sees` where some texel at or around the taps, other than on the self-shadowing
    /// surface, sees the blocker or anything as near to the light.
    /// @param indices  Among the lookups.
    void look_around(const TracedLookups& lookups, std::span<const TapSet> own,
                     std::span<const std::size_t> indices)
    {
        std::vector<std::size_t> pixels;
        std::vector<scene::Texel> texels;
        std::vector<std::size_t> ends;
        for (const std::size_t index : indices) {
            const std::size_t pixel = lookups.pixel(index);
            const auto taps = lookups.taps_of(index);
            for (std::size_t t = 0; t < taps.size(); ++t) {
                if (taps[t].is_inside && !own[index][t]) {
                    texels.push_back(taps[t].texel);
                }
            }
            const auto ring = footprint_.ring(inputs_.unbiased.at(pixel));
            texels.insert(texels.end(), ring.begin(), ring.end());
            pixels.push_back(pixel);
            ends.push_back(texels.size());
        }
        const TexelHits hits{inputs_.light, texels, renderers::HitDetail::placed};
        const auto blockers = inputs_.light.find_blockers(pixels, scene::Cull::none);
        std::vector<std::vector<renderers::SelfShadowingQuery>> nearer(pixels.size());
        std::size_t next = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double middle_m =
                0.5 * (blockers[i].light_distance_m + blockers[i].receiver_light_distance_m);
            for (; next < ends[i]; ++next) {
                const renderers::TexelHit& hit = hits[texels[next]];
                if (hit.light_distance_m < middle_m) {
                    nearer[i].push_back({pixels[i], texels[next], hit.triangle});
                }
            }
        }
        find_seen(std::move(nearer));
    }

    /// Tries one texel of each pixel at a time: usually the first is not its self-shadowing
    /// surface.
    void find_seen(std::vector<std::vector<renderers::SelfShadowingQuery>> nearer)
    {
        std::erase_if(nearer, [](const auto& queries) { return queries.empty(); });
        while (!nearer.empty()) {
            std::vector<renderers::SelfShadowingQuery> asked;
            for (auto& queries : nearer) {
                asked.push_back(queries.back());
                queries.pop_back();
            }
            const auto own = inputs_.light.are_self_shadowing(asked);
            for (std::size_t i = 0; i < nearer.size(); ++i) {
                if (own[i] == 0) {
                    causes_.pixels[asked[i].pixel].sees = true;
                    nearer[i].clear();
                }
            }
            std::erase_if(nearer, [](const auto& queries) { return queries.empty(); });
        }
    }

    const CauseInputs& inputs_;
    const scene::Image<std::uint8_t>& wanted_;
    PixelCauses& causes_;
    CauseCache* cache_;
    LookupRule rule_;
    Footprint footprint_;
    bool is_made_of_taps_;
};

} // namespace

void find_blocked_causes(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                         PixelCauses& causes, CauseCache* cache)
{
    require_cause_inputs(inputs);
    BlockedCauses{inputs, wanted, causes, cache}.find();
}

} // namespace gnomon::analysis
