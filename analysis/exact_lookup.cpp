#include "analysis/exact_lookup.hpp"

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
    ExactLookup(const LookupRules& rules, const Lookups& lookups, const TexelHits& hits,
                const scene::ExactLight& light)
        : rules_{rules},
          lookups_{lookups},
          hits_{hits},
          light_{light},
          clamps_{rules.lookup.outside == Outside::clamp}
    {
    }

    [[nodiscard]] std::vector<float> find() const
    {
        switch (rules_.lookup.filter) {
        case Filter::linear:
            return interpolated();
        case Filter::hardware:
            return weighted();
        default:
            return median_of_taps();
        }
    }

private:
    [[nodiscard]] ExactTap exact_tap(const Tap& tap) const
    {
        if (!tap.is_inside) {
            return {tap.texel, scene::no_triangle, rules_.border_depth()};
        }
        return {tap.texel, hits_[tap.texel].triangle, rules_.farthest_depth()};
    }

    /// Linear: the taps' depths are interpolated, then compared.
    [[nodiscard]] std::vector<float> interpolated() const
    {
        std::vector<LinearQuery> queries(lookups_.pixels.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            queries[i].pixel = lookups_.pixels[i];
            const auto taps = lookups_.taps_of(i);
            for (std::size_t t = 0; t < taps.size(); ++t) {
                queries[i].taps[t] = exact_tap(taps[t]);
                queries[i].weights[t] = taps[t].weight;
            }
        }
        return light_.critical_biases(queries, clamps_);
    }

    /// Hardware: each tap is compared; the verdict is lit when half of the weight is.
    [[nodiscard]] std::vector<float> weighted() const
    {
        std::vector<NearestQuery> queries;
        queries.reserve(lookups_.taps.size());
        for (std::size_t i = 0; i < lookups_.pixels.size(); ++i) {
            for (const Tap& tap : lookups_.taps_of(i)) {
                queries.push_back({lookups_.pixels[i], exact_tap(tap)});
            }
        }
        const std::vector<float> critical = light_.critical_biases(queries, clamps_);
        std::vector<float> result(lookups_.pixels.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] =
                half_weight(lookups_.taps_of(i), std::span{critical}.subspan(i * lookups_.taps_each,
                                                                             lookups_.taps_each));
        }
        return result;
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

    /// Nearest and pcf: the ⌈K²/2⌉-th smallest of the taps' critical biases. It belongs to the tap
    /// of that rank by depth, so that only taps as deep as that one have to be asked.
    [[nodiscard]] std::vector<float> median_of_taps() const
    {
        std::vector<float> result(lookups_.pixels.size());
        std::vector<NearestQuery> queries;
        std::vector<Rank> ranks;
        std::vector<double> keys;
        for (std::size_t i = 0; i < result.size(); ++i) {
            keys.clear();
            for (const Tap& tap : lookups_.taps_of(i)) {
                keys.push_back(key(tap));
            }
            const std::size_t middle = (keys.size() + 1) / 2 - 1;
            std::vector<double> sorted = keys;
            std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(middle));
            const double median = sorted[middle];
            if (std::isinf(median)) {
                result[i] = static_cast<float>(median);
                continue;
            }
            Rank rank{i, middle, queries.size(), 0};
            for (std::size_t t = 0; t < keys.size(); ++t) {
                if (keys[t] < median - depth_doubt) {
                    --rank.rank;
                } else if (keys[t] <= median + depth_doubt) {
                    queries.push_back({lookups_.pixels[i], exact_tap(lookups_.taps_of(i)[t])});
                    ++rank.count;
                }
            }
            ranks.push_back(rank);
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

    /// Orders taps as their critical biases: those lit by the smallest bias first.
    [[nodiscard]] double key(const Tap& tap) const
    {
        if (!tap.is_inside) {
            return rules_.lookup.outside == Outside::shadowed ? double{infinity}
                                                              : -double{infinity};
        }
        const double depth = hits_[tap.texel].depth;
        return rules_.reversed ? depth : -depth;
    }

    /// Which of the queries [first, first + count) answers for a lookup: the one of this rank.
    struct Rank {
        std::size_t lookup;
        std::size_t rank;
        std::size_t first;
        std::size_t count;
    };

    const LookupRules& rules_;
    const Lookups& lookups_;
    const TexelHits& hits_;
    const scene::ExactLight& light_;
    bool clamps_;
};

} // namespace

std::vector<float> exact_critical_biases(const LookupRules& rules, const Lookups& lookups,
                                         const TexelHits& hits, const scene::ExactLight& light)
{
    return ExactLookup{rules, lookups, hits, light}.find();
}

} // namespace gnomon::analysis
