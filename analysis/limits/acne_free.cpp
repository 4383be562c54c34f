#include "analysis/limits/acne_free.hpp"

#include "analysis/pixels/pixel_runs.hpp"
#include "analysis/pixels/radix_sort.hpp"
#include "methods/lookup_traits.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>

namespace gnomon::analysis {

using scene::infinity;

namespace {

/// Smallest bias with at most `allowed` of the ascending critical biases above it.
float smallest_leaving(const std::vector<float>& criticals, std::uint64_t allowed)
{
    return criticals.size() <= allowed ? -infinity : criticals[criticals.size() - 1 - allowed];
}

/// Finds the bias from which on a pixel is not acne; −∞ if it never is.
class AcneEnd {
public:
    explicit AcneEnd(const AcneInputs& inputs) : inputs_{inputs} {}

    [[nodiscard]] float of(std::size_t pixel, std::span<const float> criticals) const
    {
        const TapSet& own = inputs_.causes.filters[pixel].own;
        std::array<double, methods::most_taps> weights; // filled as far as it is read
        inputs_.taps->weights(pixel, weights);
        const float wrong_until = first_end(pixel, criticals);
        ShadowingTaps shadowing;
        for (std::size_t t = 0; t < criticals.size(); ++t) {
            if (criticals[t] >= wrong_until) {
                (own[t] ? shadowing.own : shadowing.others) += weights[t];
            }
        }
        if (label_of_lit(Cause::resolution, shadowing) == Label::acne) {
            return wrong_until; // the usual case
        }
        // Of the taps; the last to become lit comes first.
        std::array<std::size_t, methods::most_taps> order;
        const auto taps = std::span{order}.first(criticals.size());
        for (std::size_t t = 0; t < taps.size(); ++t) {
            taps[t] = t;
        }
        std::ranges::sort(taps, std::greater<>{}, [&](std::size_t t) { return criticals[t]; });
        std::size_t next = 0;
        while (next < taps.size() && criticals[taps[next]] >= wrong_until) {
            ++next;
        }
        while (next < taps.size()) {
            const float until = criticals[taps[next]];
            for (; next < taps.size() && criticals[taps[next]] == until; ++next) {
                (own[taps[next]] ? shadowing.own : shadowing.others) += weights[taps[next]];
            }
            if (label_of_lit(Cause::resolution, shadowing) == Label::acne) {
                return until;
            }
        }
        return -infinity;
    }

private:
    /// The bias from which on the pixel is on the right side of one half.
    [[nodiscard]] float first_end(std::size_t pixel, std::span<const float> criticals) const
    {
        if (!inputs_.adds_taps || inputs_.weighs_taps) {
            return inputs_.critical_bias[pixel];
        }
        std::array<float, methods::most_taps> copy{};
        const auto last = std::ranges::copy(criticals, copy.begin()).out;
        const auto middle =
            copy.begin() + static_cast<std::ptrdiff_t>(deciding_rank(criticals.size()));
        std::nth_element(copy.begin(), middle, last);
        return *middle;
    }

    const AcneInputs& inputs_;
};

/// Counts the values in each of several equal ranges of sort keys.
class KeyHistogram {
public:
    static constexpr unsigned digit_bits = 16;

    /// @param prefix  Counts only values whose key has this upper half, by its lower half. Beyond
    ///                16 bits: counts all values, by their upper half.
    explicit KeyHistogram(std::uint32_t prefix) : prefix_{prefix}, counts_(1U << digit_bits) {}

    static constexpr std::uint32_t no_prefix = 1U << digit_bits;

    void add(float value, std::uint64_t times)
    {
        const std::uint32_t key = sort_key(value);
        if (prefix_ == no_prefix) {
            counts_[key >> digit_bits] += times;
        } else if (key >> digit_bits == prefix_) {
            counts_[key & (no_prefix - 1)] += times;
        }
    }
    void add(const KeyHistogram& other)
    {
        std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus<>{});
    }

    struct Place {
        std::uint32_t digit = 0;
        std::uint64_t above = 0; ///< number of larger values that share the digit
    };
    /// Locates the value that has `larger` larger ones. Precondition: there are more values than
    /// that.
    [[nodiscard]] Place find(std::uint64_t larger) const
    {
        std::uint32_t digit = no_prefix - 1;
        for (; counts_[digit] <= larger; --digit) {
            larger -= counts_[digit];
        }
        return {digit, larger};
    }
    [[nodiscard]] std::uint64_t total() const
    {
        std::uint64_t sum = 0;
        for (const std::uint64_t count : counts_) {
            sum += count;
        }
        return sum;
    }

private:
    std::uint32_t prefix_;
    std::vector<std::uint64_t> counts_;
};

/// Histograms that one pass fills.
struct KeyHistograms {
    std::vector<KeyHistogram> all;

    void add(float value, std::uint64_t times)
    {
        for (KeyHistogram& histogram : all) {
            histogram.add(value, times);
        }
    }
    void add(const KeyHistograms& other)
    {
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].add(other.all[i]);
        }
    }
};

/// Results of one pass over the taps.
struct AcneTally {
    std::vector<float> ends; ///< for each pixel that can be acne, the bias from which on it is not
    KeyHistograms own_taps;  ///< critical biases of the taps through which lit pixels are acne

    void add(const AcneTally& other)
    {
        ends.insert(ends.end(), other.ends.begin(), other.ends.end());
        own_taps.add(other.own_taps);
    }
};

/// Acne of lookups that read several texels. Does not store the taps' critical biases: 9 × 9 taps
/// have 75 million for a full-screen image.
class AcneOfTaps {
public:
    explicit AcneOfTaps(const AcneInputs& inputs)
        : inputs_{inputs},
          largest_{inputs.adds_taps ? inputs.classes.size() : scene::ImageSize{0, 0}, -infinity}
    {
        const AcneTally none{{}, {{KeyHistogram{KeyHistogram::no_prefix}}}};
        tally_ = sum_over_runs(
            inputs.classes.pixel_count(), none,
            [&](std::size_t first, std::size_t last, AcneTally& sum) { tally(first, last, sum); });
        radix_sort(tally_.ends);
    }

    [[nodiscard]] const std::vector<float>& ends() const { return tally_.ends; }

    /// The smallest biases with self-shadowing taps worth at most this many pixels above them.
    [[nodiscard]] std::vector<float> smallest_leaving(std::span<const std::uint64_t> pixels) const
    {
        std::vector<std::uint64_t> taps; // in units of a tap's weight
        for (const std::uint64_t allowed : pixels) {
            taps.push_back(allowed * units_each());
        }
        const KeyHistogram& upper = tally_.own_taps.all.front();
        const std::uint64_t all = upper.total();
        KeyHistograms lower;
        std::vector<KeyHistogram::Place> places;
        std::uint32_t lowest = KeyHistogram::no_prefix;
        for (const std::uint64_t larger : taps) {
            places.push_back(larger < all ? upper.find(larger) : KeyHistogram::Place{});
            lower.all.emplace_back(places.back().digit);
            lowest = larger < all ? std::min(lowest, places.back().digit) : lowest;
        }
        lower = count_from(lowest, lower);
        std::vector<float> biases;
        for (std::size_t i = 0; i < taps.size(); ++i) {
            const auto key = [&] {
                const std::uint32_t digit = lower.all[i].find(places[i].above).digit;
                return (places[i].digit << KeyHistogram::digit_bits) + digit;
            };
            biases.push_back(taps[i] < all ? value_of_key(key()) : -infinity);
        }
        return biases;
    }

private:
    /// Total weight of a pixel's taps.
    [[nodiscard]] std::uint64_t units_each() const
    {
        constexpr std::uint64_t fine = 1U << 20U;
        return inputs_.weighs_taps ? fine : inputs_.taps->taps_each();
    }
    /// Calls `visit(tap, units)` for the pixel's self-shadowing taps, with their weights.
    template <typename Visit>
    void visit_weights(std::size_t pixel, const TapSet& own, const Visit& visit) const
    {
        const std::size_t taps = inputs_.taps->taps_each();
        if (!inputs_.weighs_taps) {
            for (std::size_t t = 0; t < taps; ++t) {
                if (own[t]) {
                    visit(t, std::uint64_t{1});
                }
            }
            return;
        }
        std::array<double, methods::most_taps> weights{};
        inputs_.taps->weights(pixel, weights);
        const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (std::size_t t = 0; t < taps; ++t) {
            if (own[t]) {
                visit(t, static_cast<std::uint64_t>(
                             std::llrint(weights[t] / all * static_cast<double>(units_each()))));
            }
        }
    }

    [[nodiscard]] bool has_acne(std::size_t pixel) const
    {
        return scene::is_lit(inputs_.classes[pixel]) &&
               inputs_.causes.pixels[pixel].if_partial == Cause::resolution &&
               inputs_.causes.filters[pixel].own.any();
    }

    /// Calls `visit(pixel, critical)` for the self-shadowing taps of the pixels for which
    /// `wants(pixel)`.
    template <typename Wants, typename Visit>
    void visit_own(std::size_t first, std::size_t last, const Wants& wants,
                   const Visit& visit) const
    {
        inputs_.taps->visit(first, last, wants,
                            [&](std::size_t pixel, std::span<const float> criticals) {
                                visit(pixel, inputs_.causes.filters[pixel].own, criticals);
                            });
    }

    void tally(std::size_t first, std::size_t last, AcneTally& sum)
    {
        const AcneEnd end{inputs_};
        KeyHistogram& histogram = sum.own_taps.all.front();
        visit_own(
            first, last, [&](std::size_t pixel) { return has_acne(pixel); },
            [&](std::size_t pixel, const TapSet& own, std::span<const float> criticals) {
                if (inputs_.adds_taps) {
                    visit_weights(pixel, own, [&](std::size_t t, std::uint64_t units) {
                        histogram.add(criticals[t], units);
                        largest_[pixel] = std::max(largest_[pixel], criticals[t]);
                    });
                }
                if (inputs_.causes.pixels[pixel].if_wrong == Cause::resolution) {
                    if (const float until = end.of(pixel, criticals); until != -infinity) {
                        sum.ends.push_back(until);
                    }
                }
            });
    }

    /// Fills the histograms from the pixels that have such taps at or above the lowest prefix.
    [[nodiscard]] KeyHistograms count_from(std::uint32_t lowest, const KeyHistograms& zero) const
    {
        return sum_over_runs(
            inputs_.classes.pixel_count(), zero,
            [&](std::size_t first, std::size_t last, KeyHistograms& sum) {
                visit_own(
                    first, last,
                    [&](std::size_t pixel) {
                        return has_acne(pixel) &&
                               sort_key(largest_[pixel]) >> KeyHistogram::digit_bits >= lowest;
                    },
                    [&](std::size_t pixel, const TapSet& own, std::span<const float> criticals) {
                        visit_weights(pixel, own, [&](std::size_t t, std::uint64_t units) {
                            sum.add(criticals[t], units);
                        });
                    });
            });
    }

    const AcneInputs& inputs_;
    scene::Image<float> largest_; ///< largest critical bias of each pixel's self-shadowing taps
    AcneTally tally_;
};

/// For lookups of one texel: the critical biases of lit pixels that can be acne, ascending.
std::vector<float> acne_criticals(const AcneInputs& inputs)
{
    std::vector<float> criticals;
    for (std::size_t i = 0; i < inputs.classes.pixel_count(); ++i) {
        if (is_acne_if_shadowed(inputs.causes.pixels[i], inputs.classes[i])) {
            criticals.push_back(inputs.critical_bias[i]);
        }
    }
    radix_sort(criticals);
    return criticals;
}

std::vector<AcneFree> smallest_leaving(const std::vector<float>& ends,
                                       std::span<const std::uint64_t> allowed_pixels)
{
    std::vector<AcneFree> found;
    for (const std::uint64_t allowed : allowed_pixels) {
        const float bias = smallest_leaving(ends, allowed);
        found.push_back({bias, bias});
    }
    return found;
}

} // namespace

std::vector<AcneFree> find_acne_free(const AcneInputs& inputs,
                                     std::span<const std::uint64_t> allowed_pixels)
{
    if (inputs.taps == nullptr) {
        return smallest_leaving(acne_criticals(inputs), allowed_pixels);
    }
    const AcneOfTaps acne{inputs};
    std::vector<AcneFree> found = smallest_leaving(acne.ends(), allowed_pixels);
    if (inputs.adds_taps) {
        const auto by_tap = acne.smallest_leaving(allowed_pixels);
        for (std::size_t i = 0; i < found.size(); ++i) {
            found[i].by_tap = by_tap[i];
        }
    }
    return found;
}

} // namespace gnomon::analysis
