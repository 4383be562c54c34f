#pragma once

#include "analysis/comparison/comparison.hpp"
#include "store/images/png.hpp"

#include <cstdint>

namespace gnomon::reports {

/// What the error panel marks at a pixel.
enum class Mark : std::uint8_t { none, indeterminate, unmatched, false_shadow, false_lit };

/// `none` for scored pixels that are right, `background`, `attached` and `out_of_light`.
[[nodiscard]] Mark mark_of(scene::PixelClass pixel_class, float verdict);

/// Okabe and Ito's colours, which people with any colour vision can tell apart.
/// Source: Okabe & Ito, "Color Universal Design", 2008.
[[nodiscard]] store::Rgb mark_colour(Mark mark);

/// The same view three times, of equal size.
struct Panels {
    store::RgbImage gl;     ///< shaded, with the shadow map's shadows
    store::RgbImage truth;  ///< shaded, with the true ones
    store::RgbImage errors; ///< the truth faded, marks on top
};

/// Shades the scene (geometric normal, soft ambient and diffuse light) and scales it to `size`.
///
/// Shading is averaged over the pixels that a panel pixel covers; marks are not: a panel pixel
/// shows the more frequent kind of error if it covers any error, else any other mark, so that no
/// error vanishes. Where there is none, verdicts that are off by less than one half tint it, by as
/// much as they are off.
/// @param size  Of each panel; at least 1 px each way.
[[nodiscard]] Panels draw_panels(const analysis::Comparison& comparison, scene::ImageSize size);

} // namespace gnomon::reports
