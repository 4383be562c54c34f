#pragma once

#include "analysis/pixels/maps_of_pixels.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <span>

namespace gnomon::analysis {

/// The length by which a constant bias moves a receiver at ζ towards the light, along the light's
/// axis.
///
///     directional:  b · (far − near)        spot:  A b ζ² / (1 + A b ζ),   A = 1/near − 1/far
///     distances:    b · far, towards the light
///
/// Reversed depth gives equal lengths.
/// @param bias              Depth units; any sign; an infinite bias gives an infinite length.
/// @param light_distance_m  Light distance ζ of the receiver [m]; > 0 for a spot.
/// @return  [m]; −∞ if a negative bias moves a spot's receiver beyond every distance.
/// Source: docs/depth_precision.md with Δ = −b; docs/bias_curve.md#units.
[[nodiscard]] double bias_length_m(const scene::LightFrustum& frustum, double bias,
                                   double light_distance_m);

/// The constant bias that moves a receiver at ζ by this length: the inverse of `bias_length_m`.
///
///     directional:  length / (far − near)    spot:  length / (A ζ (ζ − length))
///
/// @param length_m  [m]; at least 0.
/// @return  Infinite if it would move a spot's receiver to the light or beyond.
[[nodiscard]] double bias_of_length(const scene::LightFrustum& frustum, double length_m,
                                    double light_distance_m);

/// Depth units per metre along the light's axis at ζ, always positive.
///
///     directional:  1 / (far − near)        spot:  1 / (A ζ²)
[[nodiscard]] double depth_per_metre(const scene::LightFrustum& frustum, double light_distance_m);

/// The smallest step of a depth format: the difference between neighbouring depths. GL's unit of
/// polygon offset is at least this; the driver chooses it, so it is measured.
///
///     n-bit unorm:  1 / (2^n − 1)        floats:  2^(e − p + 1), e the exponent of the depth
///     rgba8:        1 / 255, half of which packing may move a depth by
///
/// with p = 24 significant bits, 11 for r16f.
/// @param depth  Decides the step of floats; 0 and subnormal depths have the smallest normal's
///               step.
/// Source: OpenGL 4.6 §14.6.5; docs/bias_curve.md#units.
[[nodiscard]] double depth_step(scene::DepthFormat format, float depth);

/// `depth_step` as a length along the light's axis at ζ [m].
[[nodiscard]] double depth_step_length_m(const scene::LightFrustum& frustum,
                                         scene::DepthFormat format, double light_distance_m);

/// The bias that each pixel needs (lit: the smallest that lights it) or allows (blocked: the
/// largest that keeps it shadowed), in four units. NaN where the pixel is not scored.
///
/// Infinite biases stay infinite: a lit pixel needs none (−∞) or no bias helps (+∞); a blocked
/// pixel allows none or all.
struct BiasMap {
    scene::Image<float> depth;  ///< depth units, those of the first map if biases are scaled
    scene::Image<float> metres; ///< along the light's axis at the receiver [m]
    scene::Image<float> texels; ///< those metres in world-space texel widths at the receiver
    scene::Image<float> steps;  ///< in the format's smallest steps at the receiver's depth
};

/// Inputs of a bias map; all images have one size and must stay alive.
struct BiasMapInputs {
    const scene::Image<float>& criticals;
    const scene::Image<scene::PixelClass>& classes;
    const scene::LookupLayers& lookup;
    const scene::Image<float>& light_distance_m; ///< light distance of each receiver [m]
    MapsOfPixels maps;
    scene::DepthFormat depth_format;
    std::span<const float> bias_scales = {}; ///< by map (`scene::View::bias_scales`)
};

/// The bias that each scored pixel needs or allows; NaN elsewhere.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] BiasMap map_biases(const BiasMapInputs& inputs);

} // namespace gnomon::analysis
