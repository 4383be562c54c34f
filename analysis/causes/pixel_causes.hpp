#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/lookup/footprint.hpp"
#include "scene/image.hpp"
#include "scene/infinity.hpp"
#include "scene/pixels/pixel_class.hpp"

namespace gnomon::analysis {

/// Everything that decides a pixel's cause, at any bias.
///
/// If the unbiased map (V1) gets a pixel right, only the bias can make it wrong or partial. Then
/// `if_wrong` and `if_partial` are `none`.
struct PixelCause {
    /// The cause where the pixel is wrong and V1 does not repair it. Lit: V3's result, `resolution`
    /// or `coverage`. Blocked: the cause.
    Cause if_wrong = Cause::none;
    /// Likewise where it is partial.
    Cause if_partial = Cause::none;
    /// Lit pixel, single tap: is the surface seen there its self-shadowing surface? Blocked pixel,
    /// cause `resolution`: does a texel at or around its taps see the blocker? Cause `filter`: does
    /// every single tap shadow it?
    bool sees = false;
    /// Lit pixel: the smallest bias, including the slope's part, at which exact depths are lit
    /// (V2).
    float exact_critical_bias = -scene::infinity;

    /// Whether only the bias can make it wrong.
    [[nodiscard]] bool is_of_bias_alone() const
    {
        return (static_cast<unsigned>(if_wrong) | static_cast<unsigned>(if_partial)) == 0;
    }
};

/// Further facts that decide a lit pixel's cause if several texels are read.
struct FilterCause {
    /// The smallest bias at which exact depths light all taps, to 1/256 of their weight.
    float exact_full_bias = -scene::infinity;
    /// The smallest bias at which the exact depth lights the texel that holds the receiver (V2n).
    float centre_bias = -scene::infinity;
    /// Whether that texel sees the receiver's self-shadowing surface. Known only if `centre_bias`
    /// is above 0 or biases below 0 matter.
    bool centre_is_own = false;
    /// The shadowing taps of the job's lookup (or all its taps) that see that surface.
    TapSet own;
    bool has_others = false; ///< whether some of the other taps do not see it
};

/// The causes of an image's pixels.
struct PixelCauses {
    scene::Image<PixelCause> pixels;
    scene::Image<FilterCause> filters; ///< empty if one texel is read
};

/// Whether a lit pixel with a single tap is acne wherever it is false shadow, which does not depend
/// on the bias. Has no branches, since they would often be mispredicted: neighbours differ in this.
[[nodiscard]] inline bool is_acne_if_shadowed(const PixelCause& pixel, scene::PixelClass truth)
{
    return (static_cast<unsigned>(scene::is_lit(truth)) &
            static_cast<unsigned>(pixel.if_wrong == Cause::resolution) &
            static_cast<unsigned>(pixel.sees)) != 0;
}

/// Weights of the taps that shadow a lit pixel.
struct ShadowingTaps {
    double own = 0;    ///< of taps that see its self-shadowing surface
    double others = 0; ///< of the other taps
};

/// The label of a lit pixel that is wrong or partial for this cause.
[[nodiscard]] inline Label label_of_lit(Cause cause, const ShadowingTaps& taps)
{
    const bool is_by_map = cause != Cause::bias && cause != Cause::coverage;
    const bool has_shadow = taps.own + taps.others > 0;
    if (!is_by_map || (cause == Cause::filter && !has_shadow)) {
        return Label::overshadow;
    }
    return taps.own > 0 && taps.own >= taps.others ? Label::acne : Label::edge;
}

/// The label of a blocked pixel that is wrong or partial for this cause.
/// @param sees  As `PixelCause::sees`.
[[nodiscard]] inline Label label_of_blocked(Cause cause, bool sees)
{
    switch (cause) {
    case Cause::none:
        return Label::none;
    case Cause::bias:
        return Label::peter_panning;
    case Cause::filter:
        return sees ? Label::bleed : Label::edge;
    case Cause::resolution:
        return sees ? Label::edge : Label::leak;
    case Cause::precision:
    case Cause::coverage:
        return Label::leak;
    }
    return Label::none;
}

} // namespace gnomon::analysis
