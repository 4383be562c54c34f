#include "analysis/metrics/peter_panning_gaps.hpp"

#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/radix_sort.hpp"
#include "analysis/pixels/statistics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace gnomon::analysis {

BlockerGapCache::BlockerGapCache(scene::ImageSize size, scene::Cull cull)
    : gaps_m_{size, unknown},
      cull_{cull}
{
}

void BlockerGapCache::find(const renderers::LightQueries& light,
                           std::span<const std::size_t> pixels)
{
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (std::isnan(gaps_m_[pixel])) {
            asked.push_back(pixel);
        }
    }
    const auto blockers = light.find_blockers(asked, cull_);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        gaps_m_[asked[i]] = blockers[i].triangle == scene::no_triangle
                                ? std::numeric_limits<double>::infinity()
                                : blockers[i].gap_m;
    }
}

ForgiveGaps forgive_footprints(BlockerGapCache& gaps, const renderers::LightQueries& light,
                               const ReceiverGeometry& geometry)
{
    return [&](std::span<const std::size_t> pixels) {
        gaps.find(light, pixels);
        std::vector<std::uint8_t> forgiven;
        forgiven.reserve(pixels.size());
        for (const std::size_t pixel : pixels) {
            forgiven.push_back(gaps.gap_m(pixel) <= geometry.footprint_m(pixel) ? 1 : 0);
        }
        return forgiven;
    };
}

std::vector<PixelGap> gaps_of_pixels(const BlockerGapCache& gaps,
                                     std::span<const std::size_t> pixels,
                                     const ReceiverGeometry& geometry, const MapsOfPixels& maps)
{
    std::vector<PixelGap> result;
    result.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        const scene::LightFrustum& map = maps.map_of(pixel);
        const double texel_m =
            map.texel_width_m(map.light_distance_m(geometry.point(pixel)), maps.resolution_texels);
        result.push_back({static_cast<float>(gaps.gap_m(pixel)),
                          static_cast<float>(gaps.gap_m(pixel) / texel_m)});
    }
    return result;
}

namespace {

/// Order statistics of a growing set whose values are all known in advance: a Fenwick tree over
/// their ranks. Source: P. M. Fenwick, "A new data structure for cumulative frequency tables",
/// Software: Practice and Experience 24 (1994).
class GrowingQuantiles {
public:
    explicit GrowingQuantiles(const std::vector<float>& values)
        : order_(values.size()),
          rank_(values.size()),
          values_(values.size()),
          tree_(values.size() + 1)
    {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        radix_sort(order_, [&](std::size_t i) { return sort_key(values[i]); });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            rank_[order_[i]] = i;
            values_[i] = values[order_[i]];
        }
    }

    /// Ignores a value that is not finite, as `find_quantiles` does.
    void insert(std::size_t index)
    {
        if (!std::isfinite(values_[rank_[index]])) {
            return;
        }
        for (std::size_t i = rank_[index] + 1; i < tree_.size(); i += i & (~i + 1)) {
            ++tree_[i];
        }
        ++count_;
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    /// The n-th smallest value in the set, n starting at 1.
    [[nodiscard]] float nth(std::size_t n) const
    {
        std::size_t position = 0;
        for (std::size_t step = std::bit_floor(tree_.size()); step > 0; step /= 2) {
            if (position + step < tree_.size() && tree_[position + step] < n) {
                position += step;
                n -= tree_[position];
            }
        }
        return values_[position];
    }

private:
    std::vector<std::size_t> order_;
    std::vector<std::size_t> rank_;
    std::vector<float> values_; ///< ascending
    std::vector<std::size_t> tree_;
    std::size_t count_ = 0;
};

/// The n-th smallest value of a set and ascending values together, n starting at 1.
float nth_of_both(const GrowingQuantiles& set, std::span<const float> values, std::size_t n)
{
    // Finds by bisection how many of the values belong to the n smallest: one more fits if it is
    // below the last that the set would contribute.
    std::size_t taken = n > set.count() ? n - set.count() : 0;
    std::size_t most = std::min(n, values.size());
    while (taken < most) {
        const std::size_t middle = std::midpoint(taken, most);
        if (values[middle] < set.nth(n - middle)) {
            taken = middle + 1;
        } else {
            most = middle;
        }
    }
    if (taken == 0) {
        return set.nth(n);
    }
    return taken == n ? values[taken - 1] : std::max(values[taken - 1], set.nth(n - taken));
}

/// Quantiles of a set and further values; ignores those that are not finite.
std::optional<Quantiles> quantiles_of_both(const GrowingQuantiles& set, std::vector<float> values)
{
    std::erase_if(values, [](float value) { return !std::isfinite(value); });
    std::ranges::sort(values);
    const std::size_t count = set.count() + values.size();
    if (count == 0) {
        return std::nullopt;
    }
    const auto nth = [&](std::size_t n) { return nth_of_both(set, values, n); };
    return Quantiles{count, nth(1), nth(quantile_rank(count, 50)), nth(quantile_rank(count, 95)),
                     nth(count)};
}

/// The gaps at a growing bias. A gap within reach of the biases no longer changes.
class GrowingGaps {
public:
    /// @param gaps  Sorted by critical bias; must outlive this.
    GrowingGaps(std::span<const PanningGap> gaps, const BiasReach& reach)
        : gaps_{gaps},
          reach_{reach},
          metres_{lengths(gaps, &PixelGap::metres)},
          texels_{lengths(gaps, &PixelGap::texels)}
    {
    }

    [[nodiscard]] Gaps at(float bias)
    {
        for (; next_ < gaps_.size() && gaps_[next_].critical_bias <= bias; ++next_) {
            limited_.push_back(next_);
        }
        std::vector<float> metres;
        std::vector<float> texels;
        std::erase_if(limited_, [&](std::size_t i) {
            const PixelGap& gap = gaps_[i].gap;
            const double most_m = reach_ ? reach_(gaps_[i].pixel, bias) : double{gap.metres};
            if (!(most_m < double{gap.metres}) || std::isinf(gap.metres)) {
                metres_.insert(i);
                texels_.insert(i);
                return true;
            }
            metres.push_back(static_cast<float>(most_m));
            texels.push_back(
                static_cast<float>(double{gap.texels} * (most_m / double{gap.metres})));
            return false;
        });
        return {quantiles_of_both(metres_, std::move(metres)),
                quantiles_of_both(texels_, std::move(texels))};
    }

private:
    static std::vector<float> lengths(std::span<const PanningGap> gaps, float PixelGap::*unit)
    {
        std::vector<float> all(gaps.size());
        std::ranges::transform(gaps, all.begin(),
                               [unit](const PanningGap& gap) { return gap.gap.*unit; });
        return all;
    }

    std::span<const PanningGap> gaps_;
    const BiasReach& reach_;
    GrowingQuantiles metres_; ///< gaps within reach
    GrowingQuantiles texels_;
    std::vector<std::size_t> limited_; ///< indices of the gaps beyond reach
    std::size_t next_ = 0;
};

} // namespace

std::vector<Gaps> find_gaps_at(std::vector<PanningGap> gaps, std::span<const float> biases,
                               const BiasReach& reach)
{
    require_ascending("find_gaps_at", biases);
    radix_sort(gaps, [](const PanningGap& gap) { return sort_key(gap.critical_bias); });
    GrowingGaps growing{gaps, reach};
    std::vector<Gaps> rows;
    rows.reserve(biases.size());
    for (const float bias : biases) {
        rows.push_back(growing.at(bias));
    }
    return rows;
}

} // namespace gnomon::analysis
