#include "analysis/exact_lookup.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::analysis {

using scene::ExactTap;
using scene::Filter;
using scene::LinearQuery;
using scene::NearestQuery;
using scene::Outside;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Two depths within 2^-48 each may lie in either order when they are closer than this.
constexpr double depth_doubt = 0x1p-46;

class ExactLookup {
public:
    ExactLookup(const TapRules& rules, const TracedLookups& lookups, const scene::ExactLight& light)
        : rules_{rules},
          lookups_{lookups},
          light_{light},
          clamps_{rules.lookup.outside == Outside::clamp}
    {
    }

    [[nodiscard]] std::vector<float> find() const
    {
        if (lookups_.size() == 0) {
            return {};
        }
        switch (rules_.lookup.filter) {
        case Filter::nearest:
            return light_.critical_biases(all_taps(), clamps_);
        case Filter::linear:
            return interpolated();
        case Filter::hardware:
            return weighted();
        default:
            return median_of_taps();
        }
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
        return hit == nullptr ? ExactTap{texel, scene::no_triangle, rules_.border_depth()}
                              : ExactTap{texel, hit->triangle, rules_.farthest_depth()};
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
    /// by depth, so that only taps as deep as that one have to be asked.
    [[nodiscard]] std::vector<float> median_of_taps() const
    {
        std::vector<float> result(lookups_.size());
        std::vector<NearestQuery> queries;
        std::vector<Rank> ranks;
        std::vector<double> keys(lookups_.size() > 0 ? lookups_.taps_of(0).size() : 0);
        std::vector<double> sorted;
        for (std::size_t i = 0; i < result.size(); ++i) {
            for (std::size_t t = 0; t < keys.size(); ++t) {
                keys[t] = key(lookups_.hits_of(i)[t]);
            }
            const std::size_t middle = (keys.size() + 1) / 2 - 1;
            sorted = keys;
            std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(middle));
            const double median = sorted[middle];
            if (std::isinf(median)) {
                result[i] = static_cast<float>(median);
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

    /// Which of the queries [first, first + count) answers for a lookup: the one of this rank.
    struct Rank {
        std::size_t lookup;
        std::size_t rank;
        std::size_t first;
        std::size_t count;
    };

    /// Adds queries for the taps whose depth cannot be told from the median's.
    [[nodiscard]] Rank ask_around(std::size_t lookup, const std::vector<double>& keys,
                                  double median, std::vector<NearestQuery>& queries) const
    {
        Rank rank{lookup, (keys.size() + 1) / 2 - 1, queries.size(), 0};
        for (std::size_t t = 0; t < keys.size(); ++t) {
            if (keys[t] < median - depth_doubt) {
                --rank.rank;
            } else if (keys[t] <= median + depth_doubt) {
                queries.push_back(query(lookup, t));
                ++rank.count;
            }
        }
        return rank;
    }

    /// Orders taps as their critical biases: those lit by the smallest bias first.
    [[nodiscard]] double key(const scene::TexelHit* hit) const
    {
        if (hit == nullptr) {
            return rules_.lookup.outside == Outside::shadowed ? double{infinity}
                                                              : -double{infinity};
        }
        return rules_.reversed ? hit->depth : -hit->depth;
    }

    const TapRules& rules_;
    const TracedLookups& lookups_;
    const scene::ExactLight& light_;
    bool clamps_;
};

} // namespace

TracedLookups::TracedLookups(Lookups lookups, const scene::ExactLight& light)
    : lookups_{std::move(lookups)},
      texels_{light, lookups_.taps},
      hits_(lookups_.taps.size())
{
    tbb::parallel_for(std::size_t{0}, hits_.size(), [&](std::size_t i) {
        const Tap& tap = lookups_.taps[i];
        hits_[i] = tap.is_inside ? &texels_[tap.texel] : nullptr;
    });
}

std::vector<float> exact_critical_biases(const TapRules& rules, const TracedLookups& lookups,
                                         const scene::ExactLight& light)
{
    return ExactLookup{rules, lookups, light}.find();
}

} // namespace gnomon::analysis
