#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace gnomon::scene {

/// The share of the light that a pixel sees: an interval that contains it, in [0, 1].
struct LightShare {
    float lo = 0;
    float hi = 0;

    [[nodiscard]] constexpr float middle() const { return (lo + hi) / 2; }
    friend constexpr bool operator==(const LightShare&, const LightShare&) = default;
};

/// What a class says of the share: all of the light, none of it, or nothing.
[[nodiscard]] constexpr LightShare share_of(PixelClass pixel_class)
{
    return {is_lit(pixel_class) ? 1.0F : 0.0F, is_blocked(pixel_class) ? 0.0F : 1.0F};
}

/// How the signs that decide the truth were found.
struct TruthSigns {
    std::uint64_t filtered = 0; ///< in double, by a proven error bound
    std::uint64_t exact = 0;    ///< in integers, where the bound did not suffice

    friend bool operator==(const TruthSigns&, const TruthSigns&) = default;
};

/// What is true of each pixel.
struct Truth {
    Image<PixelClass> pixel_class;
    Image<ClassReason> reason;
    Image<std::uint32_t> witness; ///< a triangle that blocks, `no_triangle` unless `blocked`
    TruthSigns signs;
    /// Of a light with an extent; empty: a scored pixel sees all of the light or none, as its class
    /// says.
    Image<LightShare> shares = {};

    /// The share of the light that a scored pixel sees.
    [[nodiscard]] LightShare share(std::size_t pixel) const
    {
        return shares.empty() ? share_of(pixel_class[pixel]) : shares[pixel];
    }
};

/// How far a verdict is from the truth, in shares of the light: too dark, too bright, or neither.
struct VerdictError {
    double too_dark = 0;   ///< in [0, 1]
    double too_bright = 0; ///< in [0, 1]; one of the two is 0

    [[nodiscard]] constexpr double amount() const { return too_dark + too_bright; }
};

/// The distance of a verdict from the share that is seen; 0 within its interval.
[[nodiscard]] constexpr VerdictError error_of(LightShare seen, float verdict)
{
    const double dark = double{seen.lo} - double{verdict};
    const double bright = double{verdict} - double{seen.hi};
    return {dark > 0 ? dark : 0, bright > 0 ? bright : 0};
}

/// True when a verdict counts as lit.
[[nodiscard]] constexpr bool is_lit(float verdict)
{
    return verdict >= 0.5F;
}

/// True of a lit pixel whose verdict does not count as lit, and of a blocked one whose verdict
/// does.
[[nodiscard]] constexpr bool is_false_shadow(PixelClass truth, float verdict)
{
    return is_lit(truth) && !is_lit(verdict);
}
[[nodiscard]] constexpr bool is_false_lit(PixelClass truth, float verdict)
{
    return is_blocked(truth) && is_lit(verdict);
}

/// Pixels that a float method for shadow rays gets wrong.
struct FloatMethodErrors {
    std::string name;
    std::uint64_t false_blocked = 0; ///< lit in truth
    std::uint64_t false_lit = 0;     ///< blocked in truth
};

} // namespace gnomon::scene
