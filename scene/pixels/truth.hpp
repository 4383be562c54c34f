#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace gnomon::scene {

/// An interval in [0, 1] that contains the share of the light that a pixel sees.
struct LightShare {
    float lo = 0;
    float hi = 0;

    [[nodiscard]] constexpr float middle() const { return (lo + hi) / 2; }
    friend constexpr bool operator==(const LightShare&, const LightShare&) = default;
};

/// The share implied by a class: 1, 0, or unknown.
[[nodiscard]] constexpr LightShare share_of(PixelClass pixel_class)
{
    return {is_lit(pixel_class) ? 1.0F : 0.0F, is_blocked(pixel_class) ? 0.0F : 1.0F};
}

/// How the signs that decide the truth were computed.
struct TruthSigns {
    std::uint64_t filtered = 0; ///< in double, by a proven error bound
    std::uint64_t exact = 0;    ///< in integers, if the bound does not suffice

    friend bool operator==(const TruthSigns&, const TruthSigns&) = default;
};

/// The truth for each pixel.
struct Truth {
    Image<PixelClass> pixel_class;
    Image<ClassReason> reason;
    Image<std::uint32_t> witness; ///< a triangle that blocks, `no_triangle` unless `blocked`
    TruthSigns signs;
    /// For area lights. Empty for point-like lights: the class of a scored pixel gives its share.
    Image<LightShare> shares = {};

    /// The share of the light that a scored pixel sees.
    [[nodiscard]] LightShare share(std::size_t pixel) const
    {
        return shares.empty() ? share_of(pixel_class[pixel]) : shares[pixel];
    }
};

/// A verdict's error, in shares of the light.
struct VerdictError {
    double too_dark = 0;   ///< in [0, 1]
    double too_bright = 0; ///< in [0, 1]; at least one of the two is 0

    [[nodiscard]] constexpr double amount() const { return too_dark + too_bright; }
};

/// The distance of a verdict from the visible share; 0 within its interval.
[[nodiscard]] constexpr VerdictError error_of(LightShare seen, float verdict)
{
    const double dark = double{seen.lo} - double{verdict};
    const double bright = double{verdict} - double{seen.hi};
    return {dark > 0 ? dark : 0, bright > 0 ? bright : 0};
}

/// Whether a verdict counts as lit.
[[nodiscard]] constexpr bool is_lit(float verdict)
{
    return verdict >= 0.5F;
}

/// Whether a lit pixel's verdict does not count as lit, or a blocked pixel's verdict does.
[[nodiscard]] constexpr bool is_false_shadow(PixelClass truth, float verdict)
{
    return is_lit(truth) && !is_lit(verdict);
}
[[nodiscard]] constexpr bool is_false_lit(PixelClass truth, float verdict)
{
    return is_blocked(truth) && is_lit(verdict);
}

/// Errors of a shadow-ray method in floating point.
struct FloatMethodErrors {
    std::string name;
    std::uint64_t false_blocked = 0; ///< lit in truth
    std::uint64_t false_lit = 0;     ///< blocked in truth
};

} // namespace gnomon::scene
