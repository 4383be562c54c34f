#include "analysis/lookup/exact_lookup.hpp"

#include "scene/infinity.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using scene::ExactTap;
using scene::infinity;
using scene::LinearQuery;
using scene::NearestQuery;
using scene::Outside;

namespace {

/// What a tap's critical bias lies between, up to an order that all taps of a lookup share.
struct Key {
    double low;
    double high;
};

class ExactLookup {
public:
    ExactLookup(const LookupRule& rule, const TracedLookups& lookups,
                const scene::ExactLight& light)
        : rule_{rule},
          lookups_{lookups},
          light_{light},
          clamps_{rule.outside == Outside::clamp}
    {
    }

    [[nodiscard]] std::vector<float> find() const
    {
        if (lookups_.size() == 0) {
            return {};
        }
        const scene::FilterPromises& promised = rule_.promises();
        if (promised.compares == scene::FilterPromises::Compares::mean_depth) {
            return interpolated();
        }
        if (promised.interpolates()) {
            return weighted();
        }
        return promised.has_one_tap() ? light_.critical_biases(all_taps(), clamps_)
                                      : median_of_taps();
    }

private:
    [[nodiscard]] NearestQuery query(std::size_t lookup, std::size_t tap) const
    {
        return {lookups_.pixel(lookup), exact_tap(lookup, tap)};
    }
    [[nodiscard]] ExactTap exact_tap(std::size_t lookup, std::size_t tap) const
    {
        const scene::Texel& texel = lookups_.taps_of(lookup)[tap].texel;
        const scene::TexelHit* hit = lookups_.hits_of(lookup)[tap];
        return hit == nullptr ? ExactTap{texel, scene::no_triangle, rule_.outside_depth(), 0}
                              : ExactTap{texel, hit->triangle, hit->depth, hit->depth_error};
    }

    /// Linear: the taps' depths are interpolated, then compared.
    [[nodiscard]] std::vector<float> interpolated() const
    {
        std::vector<LinearQuery> queries(lookups_.size());
        tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
            queries[i].pixel = lookups_.pixel(i);
            const auto taps = lookups_.taps_of(i);
            for (std::size_t t = 0; t < taps.size(); ++t) {
                queries[i].taps[t] = exact_tap(i, t);
                queries[i].weights[t] = taps[t].weight;
            }
        });
        return light_.critical_biases(queries, clamps_);
    }

    /// Hardware: each tap is compared; the verdict is lit when half of the weight is.
    [[nodiscard]] std::vector<float> weighted() const
    {
        const std::vector<float> critical = light_.critical_biases(all_taps(), clamps_);
        const std::size_t each = lookups_.taps_of(0).size();
        std::vector<float> result(lookups_.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] =
                half_weight(lookups_.taps_of(i), std::span{critical}.subspan(i * each, each));
        }
        return result;
    }

    /// A query for each tap of each lookup.
    [[nodiscard]] std::vector<NearestQuery> all_taps() const
    {
        std::vector<NearestQuery> queries(lookups_.tap_count());
        tbb::parallel_for(std::size_t{0}, lookups_.size(), [&](std::size_t i) {
            const std::size_t each = lookups_.taps_of(i).size();
            for (std::size_t t = 0; t < each; ++t) {
                queries[i * each + t] = query(i, t);
            }
        });
        return queries;
    }

    /// The smallest of the taps' critical biases with which taps of half the weight are lit.
    static float half_weight(std::span<const Tap> taps, std::span<const float> critical)
    {
        std::vector<std::pair<float, double>> order;
        for (std::size_t t = 0; t < taps.size(); ++t) {
            order.emplace_back(critical[t], taps[t].weight);
        }
        std::ranges::sort(order);
        double lit = 0;
        for (const auto& [bias, weight] : order) {
            lit += weight;
            if (lit >= 0.5) {
                return bias;
            }
        }
        return infinity; // not reached: the weights' sum is 1
    }

    /// pcf: the ⌈K²/2⌉-th smallest of the taps' critical biases. It belongs to the tap of that rank
    /// by depth, so that only taps which may be that one have to be asked.
    [[nodiscard]] std::vector<float> median_of_taps() const
    {
        std::vector<float> result(lookups_.size());
        std::vector<NearestQuery> queries;
        std::vector<Rank> ranks;
        std::vector<Key> keys(lookups_.taps_of(0).size());
        std::vector<double> ends(keys.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            std::ranges::transform(lookups_.hits_of(i), keys.begin(),
                                   [&](const scene::TexelHit* hit) { return key(hit); });
            const Key median{middle_of(keys, &Key::low, ends), middle_of(keys, &Key::high, ends)};
            if (median.low == median.high && std::isinf(median.low)) {
                result[i] = static_cast<float>(median.low);
            } else {
                ranks.push_back(ask_around(i, keys, median, queries));
            }
        }
        std::vector<float> critical = light_.critical_biases(queries, clamps_);
        for (const Rank& rank : ranks) {
            const auto first = critical.begin() + static_cast<std::ptrdiff_t>(rank.first);
            const auto last = first + static_cast<std::ptrdiff_t>(rank.count);
            const auto middle = first + static_cast<std::ptrdiff_t>(rank.rank);
            std::nth_element(first, middle, last);
            result[rank.lookup] = *middle;
        }
        return result;
    }

    /// The keys' ends of middle rank.
    /// @param ends  of the same size; overwritten.
    [[nodiscard]] static double middle_of(const std::vector<Key>& keys, double Key::*end,
                                          std::vector<double>& ends)
    {
        std::ranges::transform(keys, ends.begin(), end);
        const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(deciding_rank(keys.size()));
        std::ranges::nth_element(ends, middle);
        return *middle;
    }

    /// Which of the queries [first, first + count) answers for a lookup: the one of this rank.
    struct Rank {
        std::size_t lookup;
        std::size_t rank;
        std::size_t first;
        std::size_t count;
    };

    /// Adds queries for the taps that may have the middle rank.
    /// @param median  what the key of middle rank lies between.
    [[nodiscard]] Rank ask_around(std::size_t lookup, const std::vector<Key>& keys,
                                  const Key& median, std::vector<NearestQuery>& queries) const
    {
        Rank rank{lookup, deciding_rank(keys.size()), queries.size(), 0};
        for (std::size_t t = 0; t < keys.size(); ++t) {
            if (keys[t].high < median.low) {
                --rank.rank;
            } else if (keys[t].low <= median.high) {
                queries.push_back(query(lookup, t));
                ++rank.count;
            }
        }
        return rank;
    }

    /// Orders taps as their critical biases: those lit by the smallest bias first.
    [[nodiscard]] Key key(const scene::TexelHit* hit) const
    {
        if (hit == nullptr) {
            const double always{rule_.policy_critical_bias()};
            return {always, always};
        }
        const double depth = rule_.reversed ? hit->depth : -hit->depth;
        // Pays for the roundings here, as a depth is in [0, 1].
        const double reach = (1 + 0x1p-50) * hit->depth_error + 0x1p-50;
        return {depth - reach, depth + reach};
    }

    const LookupRule& rule_;
    const TracedLookups& lookups_;
    const scene::ExactLight& light_;
    bool clamps_;
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

TracedLookups::TracedLookups(Lookups lookups, const scene::ExactLight& light,
                             const TexelHits* known)
    : lookups_{std::move(lookups)},
      texels_{light, unknown_texels(lookups_.taps, known), scene::HitDetail::bounded},
      hits_(lookups_.taps.size())
{
    tbb::parallel_for(std::size_t{0}, hits_.size(), [&](std::size_t i) {
        const Tap& tap = lookups_.taps[i];
        if (tap.is_inside) {
            const scene::TexelHit* const hit = known == nullptr ? nullptr : known->find(tap.texel);
            hits_[i] = hit == nullptr ? &texels_[tap.texel] : hit;
        }
    });
}

std::vector<float> exact_critical_biases(const LookupRule& rule, const TracedLookups& lookups,
                                         const scene::ExactLight& light)
{
    return ExactLookup{rule, lookups, light}.find();
}

} // namespace gnomon::analysis
