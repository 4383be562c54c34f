#include "reports/page/packed_blocks.hpp"
#include "reports/page/page_html.hpp"
#include "reports/pictures/picture.hpp"
#include "scene/error.hpp"
#include "store/images/layer_file.hpp"
#include "store/images/png.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace gnomon::reports {

namespace {

/// A third of the page's width, in the pixels of a dense screen.
constexpr double picture_width_px = 640;
constexpr double most_height_px = 640;

std::optional<Panels> panels_of(const std::filesystem::path& layers)
{
    try {
        store::LayerFile file{layers, ""};
        return draw_panels(file, page_picture_size(file.size()));
    } catch (const scene::InputError&) {
        return std::nullopt; // the page's images report the damage
    }
}

} // namespace

scene::ImageSize page_picture_size(scene::ImageSize image)
{
    const double scale =
        std::min(picture_width_px / image.width_px, most_height_px / image.height_px);
    const auto scaled = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(scale * side)));
    };
    return {scaled(image.width_px), scaled(image.height_px)};
}

HeadlinePicture write_page_picture(const store::RgbImage& image, std::string_view name,
                                   std::string alt, const std::filesystem::path& out)
{
    const std::vector<std::byte> png = encode_png(image);
    store::make_folder(out / "pictures");
    const std::string file = fmt::format("pictures/{}.png", name);
    store::write_file(out / file, {reinterpret_cast<const char*>(png.data()), png.size()});
    return {file, std::move(alt), image.size(), "data:image/png;base64," + base64(png)};
}

std::vector<HeadlinePicture> headline_pictures(const store::RunReader& run,
                                               const RunOverview& overview,
                                               const std::filesystem::path& out)
{
    const std::string id = overview.headline ? overview.headline->result.text("id") : std::string{};
    const auto panels = store::has_image(run.folder(), id)
                            ? panels_of(store::pixels_path(run.folder(), id))
                            : std::nullopt;
    if (!panels) {
        return {};
    }
    const std::string scene = overview.scene.empty() ? "The scene" : overview.scene;
    return {write_page_picture(panels->gl, "drawn", scene + " with the shadows of the map", out),
            write_page_picture(panels->truth, "true", scene + " with its true shadows", out),
            write_page_picture(panels->errors, "wrong",
                               scene +
                                   " with its wrong pixels marked: falsely shadowed ones orange, "
                                   "falsely lit ones blue",
                               out)};
}

} // namespace gnomon::reports
