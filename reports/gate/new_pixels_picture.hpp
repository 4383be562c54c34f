#pragma once

#include "reports/pictures/canvas.hpp"
#include "scene/image.hpp"
#include "store/images/png.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// What became of a pixel since the baseline.
enum class PixelChange : std::uint8_t {
    none = 0,
    mended = 1,           ///< wrong in the baseline, right now
    wrong_before = 2,     ///< wrong in both
    new_false_shadow = 3, ///< was right
    new_false_lit = 4,    ///< was right
};

/// Where pixels became wrong; images of one size.
struct NewPixelsPicture {
    std::string title;
    std::vector<std::string> lines; ///< beneath it
    store::RgbImage ground;         ///< the scene, shaded, without any marks
    scene::Image<PixelChange> marks;
};

/// The whole image, and beside it the place with the most new wrong pixels, magnified; a legend
/// with counts beneath. Okabe and Ito's colours, on a ground of light greys. Marks never vanish
/// where a large image is scaled down.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
draw_new_pixels_picture(const NewPixelsPicture& picture,
                        const std::filesystem::path& font_folder = default_font_folder);

/// The scene of a configuration's kept pixels, in light greys; shadows are the true ones.
/// @throws scene::InputError  as `LayerFile` does.
[[nodiscard]] store::RgbImage shaded_ground(const std::filesystem::path& run,
                                            const std::string& id);

} // namespace gnomon::reports
