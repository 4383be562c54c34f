#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/layout.hpp"
#include "store/images/png.hpp"

#include <cstdint>
#include <optional>

namespace gnomon::store {
class LayerFile;
} // namespace gnomon::store

namespace gnomon::reports {

/// A pixel's mark in the error panel.
enum class Mark : std::uint8_t { none, indeterminate, unmatched, false_shadow, false_lit };

/// `none` for correct scored pixels, `background`, `attached` and `out_of_light`.
[[nodiscard]] Mark mark_of(scene::PixelClass pixel_class, float verdict);

/// Okabe and Ito's colours, which are distinct for any colour vision.
/// Source: Okabe & Ito, "Color Universal Design", 2008.
[[nodiscard]] store::Rgb mark_colour(Mark mark);

/// Panels of the same view and size.
struct Panels {
    store::RgbImage gl;     ///< shaded, with the shadow map's shadows
    store::RgbImage truth;  ///< shaded, with the true shadows
    store::RgbImage errors; ///< the faded truth with marks on top
};

/// Shades the scene (geometric normal, soft ambient and diffuse light) and scales it to `size`.
///
/// Shading is averaged over the pixels that a panel pixel covers, but marks are not. A panel pixel
/// that covers any error shows the more frequent kind, else any other mark, so that no error
/// vanishes. Elsewhere, verdicts that are off by less than one half tint it in proportion.
/// @param size  Of each panel; at least 1 px each way.
/// @param part  The part of the image to show; the whole image if empty.
[[nodiscard]] Panels draw_panels(const analysis::Comparison& comparison, scene::ImageSize size,
                                 const std::optional<ImagePart>& part = {});

/// The error panel alone, with other verdicts than the comparison's.
/// @param verdicts  Of the image's size.
[[nodiscard]] store::RgbImage draw_errors(const analysis::Comparison& comparison,
                                          const scene::Image<float>& verdicts,
                                          scene::ImageSize size,
                                          const std::optional<ImagePart>& part = {});

/// As above, from the layers of `write_aov`. They lack the direction to the eye, so its faint light
/// is the same everywhere.
/// @throws scene::InputError  as `LayerFile` does.
[[nodiscard]] Panels draw_panels(store::LayerFile& layers, scene::ImageSize size);

} // namespace gnomon::reports
