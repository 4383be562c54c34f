#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::scene {

/// How a lookup filters the map: a row of `filters()` each.
enum class Filter : std::uint8_t { nearest, linear, hardware, pcf3, pcf5, pcf7, pcf9 };

/// What a filter promises of its lookups. Ask this, not which filter it is.
struct FilterPromises {
    enum class Compares : std::uint8_t {
        each_tap, ///< each tap's depth with the receiver's: the verdict is the share, by weight, of
                  ///< lit taps
        mean_depth, ///< the mean, by weight, of the taps' depths: one comparison
    };
    enum class Weights : std::uint8_t {
        equal,
        bilinear,      ///< by the place between texel centres
        bilinear_of_gl ///< the same, as a driver rounds it: the map's answers to other biases are
                       ///< GL's own
    };

    /// What answers for every constant bias: the verdict rises with it.
    enum class Curve : std::uint8_t {
        by_formula,   ///< what one lookup returns
        by_bisection, ///< GL itself, asked with biases of its own for each pixel
        none
    };

    std::string_view name; ///< in job files
    int width_texels = 1;  ///< of the square of texels that are its taps
    Compares compares = Compares::each_tap;
    Weights weights = Weights::equal;

    [[nodiscard]] constexpr std::size_t tap_count() const
    {
        const auto width = static_cast<std::size_t>(width_texels);
        return width * width;
    }
    [[nodiscard]] constexpr bool has_one_tap() const { return width_texels == 1; }
    /// Whether a verdict can lie between 0 and 1.
    [[nodiscard]] constexpr bool has_fractions() const
    {
        return !has_one_tap() && compares == Compares::each_tap;
    }
    /// Whether taps lie around the point looked up, and not about the texel that holds it.
    [[nodiscard]] constexpr bool interpolates() const { return weights != Weights::equal; }
    /// Whether each verdict follows from one depth that the lookup returns.
    [[nodiscard]] constexpr bool returns_deciding_depth() const
    {
        return has_one_tap() || compares == Compares::mean_depth;
    }
    /// How the critical bias of each pixel is found.
    [[nodiscard]] constexpr Curve curve() const
    {
        return weights == Weights::bilinear_of_gl ? Curve::by_bisection : Curve::by_formula;
    }
    [[nodiscard]] constexpr bool has_curve() const { return curve() != Curve::none; }
    /// Whether every constant bias follows from one lookup.
    [[nodiscard]] constexpr bool has_formula() const { return curve() == Curve::by_formula; }
    /// Comparisons of equal weight that make a verdict; 0 where weights are not equal.
    [[nodiscard]] constexpr int equal_taps() const
    {
        if (!has_formula()) {
            return 0;
        }
        return compares == Compares::mean_depth ? 1 : static_cast<int>(tap_count());
    }
};

/// All filters, in the order of their enumerators.
[[nodiscard]] std::span<const FilterPromises> filters();
[[nodiscard]] const FilterPromises& promises(Filter filter);
[[nodiscard]] std::string_view filter_name(Filter filter);
/// Taps across a filter's footprint.
[[nodiscard]] int filter_width_texels(Filter filter);

/// No filter has more taps than this.
inline constexpr std::size_t most_taps = 81;

} // namespace gnomon::scene
