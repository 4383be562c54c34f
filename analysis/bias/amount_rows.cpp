#include "analysis/bias/amount_rows.hpp"

#include "analysis/bias/bias_index.hpp"
#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/lookup_traits.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

/// The change from one bias to the next.
struct AmountChange {
    std::int64_t shadow_taps = 0; ///< shadowed taps of lit pixels
    std::int64_t light_taps = 0;  ///< lit taps of blocked pixels
    std::int64_t partial = 0;     ///< pixels

    AmountChange& operator+=(const AmountChange& other)
    {
        shadow_taps += other.shadow_taps;
        light_taps += other.light_taps;
        partial += other.partial;
        return *this;
    }
    friend AmountChange operator+(AmountChange a, const AmountChange& b) { return a += b; }
};

/// Amounts at each bias, stored as differences between neighbouring biases.
class AmountChanges {
public:
    explicit AmountChanges(std::size_t biases) : changes_(biases + 1) {}

    /// Counts a pixel whose taps become lit at these biases, in any order.
    void add(PixelClass truth, std::span<std::size_t> lit_from)
    {
        const bool is_lit = scene::is_lit(truth);
        const std::size_t end = changes_.size() - 1;
        for (const std::size_t change : lit_from) {
            (is_lit ? changes_[0].shadow_taps : changes_[change].light_taps) += 1;
            (is_lit ? changes_[change].shadow_taps : changes_[end].light_taps) -= 1;
        }
        // Partial: on the right side of one half, but some taps are wrong.
        const auto middle =
            lit_from.begin() + static_cast<std::ptrdiff_t>(deciding_rank(lit_from.size()));
        std::nth_element(lit_from.begin(), middle, lit_from.end());
        const std::size_t side = *middle;
        const auto [least, most] = std::minmax_element(lit_from.begin(), lit_from.end());
        changes_[is_lit ? side : *least].partial += 1;
        changes_[is_lit ? *most : side].partial -= 1;
    }
    void add(const AmountChanges& other)
    {
        std::transform(changes_.begin(), changes_.end(), other.changes_.begin(), changes_.begin(),
                       std::plus<>{});
    }
    [[nodiscard]] std::vector<ErrorAmounts> sums(std::size_t taps) const
    {
        std::vector<ErrorAmounts> sums(changes_.size() - 1);
        AmountChange sum;
        const auto each = static_cast<double>(taps);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sum += changes_[i];
            sums[i] = {static_cast<double>(sum.shadow_taps) / each,
                       static_cast<double>(sum.light_taps) / each,
                       static_cast<std::uint64_t>(sum.partial), 0};
        }
        return sums;
    }

private:
    std::vector<AmountChange> changes_;
};

} // namespace

std::vector<ErrorAmounts> sum_amounts(const scene::Image<PixelClass>& classes,
                                      const TapCriticals& taps, std::span<const float> biases)
{
    require_ascending("sum_amounts", biases);
    const BiasIndex index{biases};
    const auto is_scored = [&](std::size_t pixel) { return scene::is_scored(classes[pixel]); };
    const auto count = [&](std::size_t begin, std::size_t end, AmountChanges& sum) {
        std::array<std::size_t, methods::most_taps> changes; // filled as far as it is read
        taps.visit(begin, end, is_scored, [&](std::size_t pixel, std::span<const float> criticals) {
            const std::span lit_from = std::span{changes}.first(criticals.size());
            std::ranges::transform(criticals, lit_from.begin(),
                                   [&](float critical) { return index.first_from(critical); });
            sum.add(classes[pixel], lit_from);
        });
    };
    return sum_over_runs(classes.pixel_count(), AmountChanges{biases.size()}, count)
        .sums(taps.taps_each());
}

std::vector<ErrorAmounts> sum_amounts(const BiasCurve& curve, std::span<const float> biases)
{
    std::vector<ErrorAmounts> amounts;
    for (const float bias : biases) {
        const ErrorCounts errors = curve.at(bias);
        amounts.push_back({static_cast<double>(errors.false_shadow),
                           static_cast<double>(errors.false_lit), 0, 0});
    }
    return amounts;
}

std::vector<scene::Image<std::uint8_t>> count_lit_taps(const scene::Image<PixelClass>& classes,
                                                       const TapCriticals& taps,
                                                       std::span<const float> biases)
{
    std::vector<scene::Image<std::uint8_t>> counts(biases.size(),
                                                   scene::Image<std::uint8_t>{classes.size()});
    const auto is_scored = [&](std::size_t pixel) { return scene::is_scored(classes[pixel]); };
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        taps.visit(first, last, is_scored,
                   [&](std::size_t pixel, std::span<const float> criticals) {
                       for (std::size_t i = 0; i < biases.size(); ++i) {
                           counts[i][pixel] = static_cast<std::uint8_t>(std::ranges::count_if(
                               criticals, [&](float critical) { return critical <= biases[i]; }));
                       }
                   });
    });
    return counts;
}

} // namespace gnomon::analysis
