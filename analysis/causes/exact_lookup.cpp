#include "analysis/causes/exact_lookup.hpp"

#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "methods/lookup_traits.hpp"
#include "scene/infinity.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using renderers::ExactTap;
using renderers::LinearQuery;
using renderers::NearestQuery;
using scene::infinity;
using scene::Outside;

namespace {

/// Bounds of a tap's critical bias, up to a monotone mapping common to all taps of a lookup.
struct Key {
    double low;
    double high;
};

class ExactLookup {
public:
    ExactLookup(const ExactComparison& comparison, const TracedLookups& lookups, LitShare share)
        : rule_{comparison.rule},
          lookups_{lookups},
          light_{comparison.light},
          kept_{comparison.kept},
          share_{share},
          always_lit_{comparison.always_lit},
          receivers_{rule_.outside == Outside::clamp,
                     kept_ == nullptr ? nullptr : &kept_->lookup.moved}
    {
    }

    [[nodiscard]] std::vector<float> find() const
    {
        if (lookups_.size() == 0) {
            return {};
        }
        const methods::LookupTraits& traits = rule_.traits;
        if (traits.compares == methods::Compares::mean_depth) {
            return interpolated();
        }
        if (traits.weighs_taps()) {
            return weighted();
        }
        return traits.has_one_tap() ? all_taps() : tap_of_rank();
    }

    [[nodiscard]] std::vector<float> find(std::span<const std::size_t> taps) const
    {
        std::vector<float> critical(lookups_.size(), rule_.border_critical_bias());
        std::vector<NearestQuery> queries;
        std::vector<std::size_t> asked;
        for (std::size_t i = 0; i < critical.size(); ++i) {
            if (lookups_.hits_of(i)[taps[i]] != nullptr || rule_.traits.interpolates()) {
                queries.push_back(query(i, taps[i]));
                asked.push_back(i);
            }
        }
        const std::vector<float> found = light_.critical_biases(queries, receivers_);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            critical[asked[i]] = found[i];
        }
        return critical;
    }

private:
    [[nodiscard]] bool is_always_lit(std::size_t lookup, std::size_t tap) const
    {
        return !always_lit_.empty() && always_lit_[lookup][tap];
    }
    [[nodiscard]] NearestQuery query(std::size_t lookup, std::size_t tap) const
    {
        return {lookups_.pixel(lookup), exact_tap(lookup, tap), lookups_.first_tap(lookup).map};
    }
    [[nodiscard]] ExactTap exact_tap(std::size_t lookup, std::size_t tap) const
    {
        const scene::Texel& texel = lookups_.taps_of(lookup)[tap].texel;
        const renderers::TexelHit* hit = lookups_.hits_of(lookup)[tap];
        const ExactTap seen = hit == nullptr
                                  ? ExactTap{texel, scene::no_triangle, rule_.outside_depth(), 0}
                                  : ExactTap{texel, hit->triangle, hit->depth, hit->depth_error};
        return kept_ == nullptr ? seen : with_terms(seen, lookup, tap);
    }
    /// The tap with its depth moved by the map's offset and by the receiver's per-tap terms.
    [[nodiscard]] ExactTap with_terms(ExactTap seen, std::size_t lookup, std::size_t tap) const
    {
        if (kept_->offsets && seen.triangle != scene::no_triangle) {
            const double offset = kept_->offsets->at(seen.texel, seen.triangle, seen.depth);
            const double moved = seen.depth + offset;
            if (moved <= 0 || moved >= 1) {
                seen = {seen.texel, scene::no_triangle, moved <= 0 ? 0.0 : 1.0, 0};
            } else {
                seen.shift = offset;
            }
        }
        // A number this large decides like infinity; NaN counts as shadow.
        constexpr double largest = 0x1p100;
        const double rise{
            kept_->rise(lookups_.pixel(lookup), centre_of(lookup, tap), lookups_.at(lookup).texel)};
        const double in_shadow = rule_.reversed ? -largest : largest;
        seen.shift -= std::isnan(rise) ? in_shadow : std::clamp(rise, -largest, largest);
        return seen;
    }
    /// Centre of a tap's texel, before any clamping. Precondition: the taps form a square.
    [[nodiscard]] scene::Vec2f centre_of(std::size_t lookup, std::size_t tap) const
    {
        const scene::Texel& first = lookups_.first_tap(lookup);
        const auto width = static_cast<std::size_t>(rule_.traits.width_texels);
        const auto at = [](int from, std::size_t step) {
            return static_cast<float>(from + static_cast<int>(step)) + 0.5F;
        };
        return {at(first.x, tap % width), at(first.y, tap / width)};
    }

    /// linear: interpolates the depths of the taps, then compares.
    [[nodiscard]] std::vector<float> interpolated() const
    {
        std::vector<LinearQuery> queries(lookups_.size());
        tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
            queries[i].pixel = lookups_.pixel(i);
            queries[i].first = lookups_.first_tap(i);
            for (std::size_t t = 0; t < queries[i].taps.size(); ++t) {
                queries[i].taps[t] = exact_tap(i, t);
            }
        });
        return light_.critical_biases(queries, receivers_);
    }

    /// Compares each tap; lit if enough of the weight is.
    [[nodiscard]] std::vector<float> weighted() const
    {
        const std::vector<float> critical = all_taps();
        const std::size_t each = lookups_.taps_of(0).size();
        std::vector<float> result(lookups_.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] =
                weight_lit(lookups_.taps_of(i), std::span{critical}.subspan(i * each, each));
        }
        return result;
    }

    /// The critical bias of each tap of each lookup.
    [[nodiscard]] std::vector<float> all_taps() const
    {
        std::vector<NearestQuery> queries(lookups_.tap_count());
        const std::size_t each = lookups_.taps_of(0).size();
        tbb::parallel_for(std::size_t{0}, lookups_.size(), [&](std::size_t i) {
            for (std::size_t t = 0; t < each; ++t) {
                queries[i * each + t] = is_of_border(i, t) ? unread_query(i) : query(i, t);
            }
        });
        std::vector<float> critical = light_.critical_biases(queries, receivers_);
        for (std::size_t i = 0; i < critical.size(); ++i) {
            if (is_of_border(i / each, i % each)) {
                critical[i] = rule_.border_critical_bias();
            } else if (is_always_lit(i / each, i % each)) {
                critical[i] = -infinity;
            }
        }
        return critical;
    }
    /// Whether the border mode alone decides the tap.
    [[nodiscard]] bool is_of_border(std::size_t lookup, std::size_t tap) const
    {
        return rule_.traits.scatters_taps() && lookups_.hits_of(lookup)[tap] == nullptr;
    }
    /// A placeholder for a tap that the border mode decides.
    [[nodiscard]] NearestQuery unread_query(std::size_t lookup) const
    {
        const scene::Texel& texel = lookups_.first_tap(lookup);
        return {lookups_.pixel(lookup), {texel, scene::no_triangle, 1, 0}, texel.map};
    }

    /// Whether the lit weight suffices.
    [[nodiscard]] bool is_enough(double lit, double all) const
    {
        switch (share_) {
        case LitShare::any:
            return lit > partial_above * all;
        case LitShare::half:
            return lit >= 0.5 * all;
        case LitShare::full:
            return lit >= (1 - partial_above) * all;
        }
        return false;
    }

    /// The smallest bias that lights taps of enough weight.
    [[nodiscard]] float weight_lit(std::span<const Tap> taps, std::span<const float> critical) const
    {
        std::vector<WeighedCritical> weighed;
        for (std::size_t t = 0; t < taps.size(); ++t) {
            weighed.emplace_back(critical[t], taps[t].weight);
        }
        return smallest_lit_bias(weighed,
                                 [this](double lit, double all) { return is_enough(lit, all); });
    }

    /// Rank of the deciding tap among K² equal taps, in the order of critical biases.
    [[nodiscard]] std::size_t rank() const
    {
        const std::size_t each = lookups_.taps_of(0).size();
        switch (share_) {
        case LitShare::any:
            return 0; // even one of 100 taps weighs more than 1/256
        case LitShare::half:
            return deciding_rank(each);
        case LitShare::full:
            return each - 1;
        }
        return 0;
    }

    /// pcf: the critical bias of the tap of the deciding rank. Orders the taps by depth, so that
    /// only those that may have this rank are traced.
    [[nodiscard]] std::vector<float> tap_of_rank() const
    {
        std::vector<float> result(lookups_.size());
        std::vector<NearestQuery> queries;
        std::vector<Rank> ranks;
        std::vector<Key> keys(lookups_.taps_of(0).size());
        std::vector<double> ends(keys.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            for (std::size_t t = 0; t < keys.size(); ++t) {
                keys[t] =
                    is_always_lit(i, t) ? Key{-double{infinity}, -double{infinity}} : key(i, t);
            }
            const Key decides{end_of_rank(keys, &Key::low, ends),
                              end_of_rank(keys, &Key::high, ends)};
            if (decides.low == decides.high && std::isinf(decides.low)) {
                result[i] = static_cast<float>(decides.low);
            } else {
                ranks.push_back(ask_around(i, keys, decides, queries));
            }
        }
        std::vector<float> critical = light_.critical_biases(queries, receivers_);
        for (const Rank& rank : ranks) {
            const auto first = critical.begin() + static_cast<std::ptrdiff_t>(rank.first);
            const auto last = first + static_cast<std::ptrdiff_t>(rank.count);
            const auto middle = first + static_cast<std::ptrdiff_t>(rank.rank);
            std::nth_element(first, middle, last);
            result[rank.lookup] = *middle;
        }
        return result;
    }

    /// The given end (low or high) of the key of the deciding rank.
    /// @param ends  Of equal size; overwritten.
    [[nodiscard]] double end_of_rank(const std::vector<Key>& keys, double Key::*end,
                                     std::vector<double>& ends) const
    {
        std::ranges::transform(keys, ends.begin(), end);
        const auto place = ends.begin() + static_cast<std::ptrdiff_t>(rank());
        std::ranges::nth_element(ends, place);
        return *place;
    }

    /// The queries [first, first + count) of a lookup, and the rank among them that decides.
    struct Rank {
        std::size_t lookup;
        std::size_t rank;
        std::size_t first;
        std::size_t count;
    };

    /// Adds queries for the taps that may have the deciding rank.
    /// @param decides  Bounds of the key of that rank.
    [[nodiscard]] Rank ask_around(std::size_t lookup, const std::vector<Key>& keys,
                                  const Key& decides, std::vector<NearestQuery>& queries) const
    {
        Rank asked{lookup, rank(), queries.size(), 0};
        for (std::size_t t = 0; t < keys.size(); ++t) {
            if (keys[t].high < decides.low) {
                --asked.rank;
            } else if (keys[t].low <= decides.high) {
                queries.push_back(query(lookup, t));
                ++asked.count;
            }
        }
        return asked;
    }

    /// Sorts taps by critical bias: those lit by the smallest bias first.
    [[nodiscard]] Key key(std::size_t lookup, std::size_t tap) const
    {
        if (lookups_.hits_of(lookup)[tap] == nullptr) {
            const double always{rule_.border_critical_bias()};
            return {always, always};
        }
        const ExactTap seen = exact_tap(lookup, tap);
        const double shifted = seen.depth + seen.shift;
        const double depth = rule_.reversed ? shifted : -shifted;
        // Covers the rounding here, since a depth is in [0, 1].
        const double reach =
            (1 + 0x1p-50) * seen.depth_error + 0x1p-50 * (1 + std::abs(seen.shift));
        return {depth - reach, depth + reach};
    }

    const LookupRule& rule_;
    const TracedLookups& lookups_;
    const renderers::LightQueries& light_;
    const KeptTerms* kept_;
    LitShare share_;
    std::span<const TapSet> always_lit_;
    renderers::ReceiverRule receivers_;
};

std::vector<scene::Texel> unknown_texels(std::span<const Tap> taps, const TexelHits* known)
{
    std::vector<scene::Texel> texels = texels_of(taps);
    if (known != nullptr) {
        std::erase_if(texels, [&](const scene::Texel& texel) { return known->find(texel); });
    }
    return texels;
}

} // namespace

TracedLookups::TracedLookups(Lookups lookups, const renderers::LightQueries& light,
                             const TexelHits* known)
    : lookups_{std::move(lookups)},
      texels_{light, unknown_texels(lookups_.taps, known), renderers::HitDetail::bounded},
      hits_(lookups_.taps.size())
{
    tbb::parallel_for(std::size_t{0}, hits_.size(), [&](std::size_t i) {
        const Tap& tap = lookups_.taps[i];
        if (tap.is_inside) {
            const renderers::TexelHit* const hit =
                known == nullptr ? nullptr : known->find(tap.texel);
            hits_[i] = hit == nullptr ? &texels_[tap.texel] : hit;
        }
    });
}

std::vector<float> exact_critical_biases(const ExactComparison& comparison,
                                         const TracedLookups& lookups, LitShare share)
{
    return ExactLookup{comparison, lookups, share}.find();
}

std::vector<float> exact_tap_biases(const ExactComparison& comparison, const TracedLookups& lookups,
                                    std::span<const std::size_t> taps)
{
    return ExactLookup{comparison, lookups, LitShare::half}.find(taps);
}

} // namespace gnomon::analysis
