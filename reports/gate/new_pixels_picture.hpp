#pragma once

#include "reports/pictures/canvas.hpp"
#include "scene/image.hpp"
#include "store/images/png.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// How a pixel changed since the baseline.
enum class PixelChange : std::uint8_t {
    none = 0,
    fixed = 1,            ///< wrong in the baseline, right now
    wrong_before = 2,     ///< wrong in both
    new_false_shadow = 3, ///< right in the baseline
    new_false_lit = 4,    ///< right in the baseline
};

/// The pixels that became wrong; both images have the same size.
struct NewPixelsPicture {
    std::string title;
    std::vector<std::string> lines; ///< below the title
    store::RgbImage ground;         ///< the shaded scene without marks
    scene::Image<PixelChange> marks;
};

/// Draws the whole image, beside it a magnified view of the part with the most new wrong pixels,
/// and a legend with counts below. Colours are Okabe and Ito's on light greys. Marks stay visible
/// when a large image is scaled down.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
draw_new_pixels_picture(const NewPixelsPicture& picture,
                        const std::filesystem::path& font_folder = default_font_folder);

/// Draws the marks over the whole image, scaled to a size. New errors hide old ones.
[[nodiscard]] store::RgbImage draw_marks(const NewPixelsPicture& picture, scene::ImageSize size);

/// Shades a configuration's kept pixels in light greys, with the true shadows.
/// @throws scene::InputError  as `LayerFile` does.
[[nodiscard]] store::RgbImage shaded_ground(const std::filesystem::path& run,
                                            const std::string& id);

} // namespace gnomon::reports
