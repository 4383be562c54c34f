#include "analysis/limits/bias_limits.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "analysis/pixels/radix_sort.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::infinity;
using scene::PixelClass;

/// The allowances are 1/n, since integers divide without rounding.
constexpr std::array<std::uint64_t, 3> allowed_one_in{10000, 1000, 100};
constexpr std::size_t verdict_allowance = 1; // no_constant_bias_serves is decided at 0.1 %
constexpr std::size_t smallest_piece = 1024; // in pixels; each call has a fixed cost

struct KeyedPixel {
    std::uint32_t key; ///< sort_key of the critical bias
    std::size_t pixel;
};

/// Blocked pixels in ascending order of critical bias, sorted only as far as needed.
class AscendingBlocked {
public:
    /// @param sorted  Critical biases of the blocked pixels, ascending. All arguments must outlive
    ///                this.
    AscendingBlocked(const scene::Image<float>& criticals, const scene::Image<PixelClass>& classes,
                     std::span<const float> sorted)
        : criticals_{criticals},
          classes_{classes},
          sorted_{sorted}
    {
    }

    [[nodiscard]] std::span<const float> criticals() const { return sorted_; }
    /// Those of the ranks from `first` to before `last`; valid until the next call.
    [[nodiscard]] std::span<const std::size_t> pixels(std::size_t first, std::size_t last)
    {
        if (first < window_first_ || last > window_first_ + window_.size()) {
            sort_window(first, std::min(std::max(last, first + least_sorted), sorted_.size()));
        }
        return std::span{window_}.subspan(first - window_first_, last - first);
    }

private:
    static constexpr std::size_t least_sorted = 16384; ///< ranks; each window looks at every pixel

    /// Sorts the pixels from these ranks, and all that are equal to the first and the last.
    void sort_window(std::size_t first, std::size_t last)
    {
        const float lowest = sorted_[first];
        const float highest = sorted_[last - 1];
        std::vector<KeyedPixel> keyed;
        for (std::size_t i = 0; i < criticals_.pixel_count(); ++i) {
            if (scene::is_blocked(classes_[i]) && criticals_[i] >= lowest &&
                criticals_[i] <= highest) {
                keyed.push_back({sort_key(criticals_[i]), i});
            }
        }
        radix_sort(keyed, [](const KeyedPixel& pixel) { return pixel.key; });
        window_.resize(keyed.size());
        std::ranges::transform(keyed, window_.begin(), &KeyedPixel::pixel);
        window_first_ =
            static_cast<std::size_t>(std::ranges::lower_bound(sorted_, lowest) - sorted_.begin());
    }

    const scene::Image<float>& criticals_;
    const scene::Image<PixelClass>& classes_;
    std::span<const float> sorted_;
    std::size_t window_first_ = 0; ///< rank
    std::vector<std::size_t> window_;
};

/// Largest bias with at most `allowed` of the ascending critical biases at or below it.
float largest_keeping(std::span<const float> criticals, std::uint64_t allowed)
{
    if (criticals.size() <= allowed || criticals[allowed] == infinity) {
        return infinity; // pixels that every bias shadows impose no limit
    }
    return previous_bias(criticals[allowed]);
}

/// Walks the blocked pixels upwards and collects the critical biases of those that are not
/// forgiven.
class Unforgiven {
public:
    Unforgiven(AscendingBlocked& blocked, const ForgiveGaps& forgive)
        : blocked_{blocked},
          forgive_{forgive}
    {
    }

    /// The first `count` critical biases, or more, that are at least `least` and not forgiven;
    /// fewer if there are not as many. Call with increasing `least`.
    std::vector<float> first(std::uint64_t count, float least)
    {
        const auto from = std::lower_bound(found_.begin(), found_.end(), least);
        std::vector<float> result{from, found_.end()};
        const auto criticals = blocked_.criticals();
        const auto skipped = std::ranges::lower_bound(criticals.subspan(next_), least);
        next_ += static_cast<std::size_t>(skipped - criticals.subspan(next_).begin());
        while (result.size() < count && next_ < criticals.size() && criticals[next_] != infinity) {
            take_piece(count - result.size(), result);
        }
        found_ = result;
        return result;
    }

private:
    void take_piece(std::uint64_t wanted, std::vector<float>& result)
    {
        const auto criticals = blocked_.criticals();
        const std::size_t size = std::min<std::size_t>(
            std::max<std::size_t>(wanted, smallest_piece), criticals.size() - next_);
        const auto piece = blocked_.pixels(next_, next_ + size);
        const std::vector<std::uint8_t> forgiven =
            forgive_ ? forgive_(piece) : std::vector<std::uint8_t>(size, 0);
        if (forgiven.size() != size) {
            throw std::invalid_argument(
                fmt::format("find_bias_bounds: forgive: returned {} answers for {} pixels",
                            forgiven.size(), size));
        }
        for (std::size_t i = 0; i < size; ++i) {
            if (forgiven[i] == 0) {
                result.push_back(criticals[next_ + i] + 0.0F);
            }
        }
        next_ += size;
    }

    AscendingBlocked& blocked_;
    const ForgiveGaps& forgive_;
    std::size_t next_ = 0;
    std::vector<float> found_;
};

void require_same_sizes(scene::ImageSize criticals, scene::ImageSize classes)
{
    if (criticals != classes) {
        throw std::invalid_argument(fmt::format(
            "find_bias_bounds: the images differ in size: criticals {}x{}, classes {}x{}",
            criticals.width_px, criticals.height_px, classes.width_px, classes.height_px));
    }
}

void set_acne_free(BiasLimits& limits, const AcneFree& acne_free)
{
    limits.acne_free = acne_free.by_tap;
    limits.acne_free_count = acne_free.by_count;
}

} // namespace

bool BiasLimits::cross() const
{
    return acne_free_count == infinity || panning_free == -infinity ||
           acne_free_count > panning_free;
}

BiasBounds find_bias_bounds(const BiasCurve& curve, const scene::Image<float>& criticals,
                            const scene::Image<PixelClass>& classes, const FindAcneFree& acne_free,
                            const ForgiveGaps& forgive)
{
    require_same_sizes(criticals.size(), classes.size());
    const std::vector<float>& all = curve.blocked();
    AscendingBlocked blocked{criticals, classes, all};
    const std::uint64_t scored = curve.scored();
    const float above_zero = next_bias(0.0F);

    BiasBounds bounds;
    const auto beyond_zero = std::lower_bound(all.begin(), all.end(), above_zero);
    std::vector<std::uint64_t> allowed{0};
    for (const std::uint64_t one_in : allowed_one_in) {
        allowed.push_back(scored / one_in);
    }
    const std::vector<AcneFree> acne = acne_free(allowed);
    set_acne_free(bounds.strict, acne[0]);
    bounds.strict.panning_free = largest_keeping(all, 0);
    bounds.strict.panning_free_beyond_zero = largest_keeping({beyond_zero, all.end()}, 0);

    const std::uint64_t most = scored / allowed_one_in.back() + 1;
    Unforgiven unforgiven{blocked, forgive};
    const std::vector<float> from_start = unforgiven.first(most, -infinity);
    const std::vector<float> from_zero = unforgiven.first(most, above_zero);
    for (std::size_t i = 0; i < allowed_one_in.size(); ++i) {
        BiasLimits& limits = bounds.allowances[i];
        limits.allowance = 1.0 / static_cast<double>(allowed_one_in[i]);
        limits.allowed_pixels = allowed[i + 1];
        set_acne_free(limits, acne[i + 1]);
        limits.panning_free = largest_keeping(from_start, limits.allowed_pixels);
        limits.panning_free_beyond_zero = largest_keeping(from_zero, limits.allowed_pixels);
    }
    bounds.no_constant_bias_serves = bounds.allowances[verdict_allowance].cross();
    return bounds;
}

} // namespace gnomon::analysis
