#pragma once

#include "methods/promises.hpp"
#include "scene/filter.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::methods {

/// How much each tap counts.
enum class Weights : std::uint8_t {
    equal,
    bilinear,      ///< by the place between texel centres
    bilinear_of_gl ///< the same, as a driver rounds it: the map's answers to other biases are GL's
                   ///< own
};

/// How GL is to sample the map.
enum class Sampling : std::uint8_t {
    fetched,      ///< texel by texel
    interpolated, ///< depths, bilinearly
    compared,     ///< comparisons of 2 × 2 texels, bilinearly
};

/// What a filter promises of its lookups. Ask this, not which filter it is.
struct FilterPromises {
    scene::Filter filter = scene::Filter::nearest;
    int width_texels = 1; ///< of the square of texels that are its taps
    Compares compares = Compares::each_tap;
    Weights weights = Weights::equal;
    Rises rises;
    Curve curve = Curve::by_formula;
    Sampling sampling = Sampling::fetched;
    /// Its piece of the lookup's shader: a name for `glsl_source`. It defines
    ///
    ///     float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
    ///
    /// the verdict in [0, 1], and d, the depth looked up; raster_gl/shaders/lookup_map.glsl is what
    /// it may call, and TAPS_ACROSS is `width_texels`.
    std::string_view glsl;
    std::string_view sentence; ///< what it computes

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
    /// Whether every constant bias is known.
    [[nodiscard]] constexpr bool has_curve() const { return curve != Curve::none; }
    /// Whether every constant bias follows from one lookup.
    [[nodiscard]] constexpr bool has_formula() const { return curve == Curve::by_formula; }
    /// Comparisons of equal weight that make a verdict; 0 where weights are not equal.
    [[nodiscard]] constexpr int equal_taps() const
    {
        if (weights == Weights::bilinear_of_gl) {
            return 0;
        }
        return compares == Compares::mean_depth ? 1 : static_cast<int>(tap_count());
    }
};

} // namespace gnomon::methods
