#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/lookup/footprint.hpp"
#include "scene/image.hpp"
#include "scene/infinity.hpp"
#include "scene/pixels/pixel_class.hpp"

namespace gnomon::analysis {

/// Everything that decides a pixel's cause, whatever the bias: one answer for all of them.
///
/// A pixel that the map without any bias (V1) gets right can only be wrong, or partial, by its
/// bias: then the members that say what else may be are `none`.
struct PixelCause {
    /// Where it is wrong and V1 does not repair that. Lit: V3's word, `resolution` or `coverage`;
    /// blocked: the cause.
    Cause if_wrong = Cause::none;
    /// The same where it is partial.
    Cause if_partial = Cause::none;
    /// A lit pixel before a single tap: is the surface seen there its self-shadowing surface? A
    /// blocked pixel of cause `resolution`: does a texel at or around its taps see the blocker? Of
    /// cause `filter`: does every tap, by itself, shadow it?
    bool sees = false;
    /// A lit pixel: the smallest bias with which exact depths are lit (V2), the slope's part
    /// included.
    float exact_critical_bias = -scene::infinity;

    /// Whether all that can be wrong with it is the bias.
    [[nodiscard]] bool is_of_bias_alone() const
    {
        return (static_cast<unsigned>(if_wrong) | static_cast<unsigned>(if_partial)) == 0;
    }
};

/// What more decides a lit pixel's cause where several texels are read.
struct FilterCause {
    /// The smallest bias with which exact depths are lit at all taps, to 1/256 of their weight.
    float exact_full_bias = -scene::infinity;
    /// The same of the texel alone that holds the receiver (V2n).
    float centre_bias = -scene::infinity;
    /// Whether that texel sees the receiver's self-shadowing surface; said only where `centre_bias`
    /// is above 0, or biases below 0 are asked about.
    bool centre_is_own = false;
    /// Taps of the job's lookup that see it, of those that shadow without bias, or of all.
    TapSet own;
    bool has_others = false; ///< whether some of those do not
};

/// The causes of an image's pixels.
struct PixelCauses {
    scene::Image<PixelCause> pixels;
    scene::Image<FilterCause> filters; ///< empty where one texel is read
};

/// True when a lit pixel before a single tap is acne wherever it is false shadow: this does not
/// depend on the bias. Without branches, which would often be mispredicted: neighbouring pixels
/// differ in whether they are acne.
[[nodiscard]] inline bool is_acne_if_shadowed(const PixelCause& pixel, scene::PixelClass truth)
{
    return (static_cast<unsigned>(scene::is_lit(truth)) &
            static_cast<unsigned>(pixel.if_wrong == Cause::resolution) &
            static_cast<unsigned>(pixel.sees)) != 0;
}

/// Weights of the taps that shadow a lit pixel.
struct ShadowingTaps {
    double own = 0;    ///< of those that see its self-shadowing surface
    double others = 0; ///< of the others
};

/// The label of a lit pixel that is wrong or partial by this cause.
[[nodiscard]] inline Label label_of_lit(Cause cause, const ShadowingTaps& taps)
{
    const bool is_by_map = cause != Cause::bias && cause != Cause::coverage;
    const bool has_shadow = taps.own + taps.others > 0;
    if (!is_by_map || (cause == Cause::filter && !has_shadow)) {
        return Label::overshadow;
    }
    return taps.own > 0 && taps.own >= taps.others ? Label::acne : Label::edge;
}

/// The label of a blocked pixel that is wrong or partial by this cause.
/// @param sees  as `PixelCause::sees`.
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
