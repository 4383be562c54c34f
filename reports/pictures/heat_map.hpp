#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/canvas.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// A quantity to draw. Each value has the same colour in every image.
enum class HeatMap : std::uint8_t {
    needed_bias, ///< that a lit pixel needs, or a blocked one allows [texels], from -100 to 100
    depth_error, ///< stored minus exact distance [m], from -1 to 1
    amount,      ///< truth minus verdict: above 0 false shadow, below 0 false light
    cause,
    label,
};

/// The quantity named "needed-bias", "depth-error", "amount", "cause" or "label".
[[nodiscard]] std::optional<HeatMap> heat_map_from_name(std::string_view name);
/// Those names, in this order.
[[nodiscard]] std::vector<std::string_view> heat_map_names();

/// Position of a value on a scale that is linear up to ±`linear` and logarithmic beyond: 0 at
/// -largest, 1/2 at 0, 1 at largest. Clamped to [0, 1].
[[nodiscard]] double share_on_scale(double value, double linear, double largest);

/// A picture of one quantity with its legend. If a large image is scaled down, each pixel shows
/// the value of the largest magnitude that it covers.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
/// @throws scene::InputError        if the comparison lacks the quantity (no bias curve, no needed
///                                  biases).
[[nodiscard]] store::RgbImage
draw_heat_map(const analysis::Comparison& comparison, HeatMap kind,
              const std::filesystem::path& font_folder = default_font_folder);

/// Draws it into a PNG file.
/// @throws  as `draw_heat_map`; scene::EnvironmentError also if it cannot be written.
void write_heat_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                    HeatMap kind);

} // namespace gnomon::reports
