#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/canvas.hpp"
#include "reports/pictures/panels.hpp"
#include "store/images/png.hpp"

#include <filesystem>
#include <optional>

namespace gnomon::reports {

/// A picture to read at a glance: panels with GL's shadows on the shaded scene, the true shadows,
/// and the errors coloured by kind, each with its counts below. A fourth panel shows the errors
/// that the recommended constant bias leaves, if `recommended_errors` has them.
///
/// Panels show `shown_part` of the image. They stand side by side, four in two rows, or stacked if
/// the part is wide. Large parts are scaled down to about 960 px per panel and small ones up by a
/// whole factor; every error stays visible.
/// @throws scene::EnvironmentError  naming the package, if the font is missing.
[[nodiscard]] store::RgbImage
draw_picture(const analysis::Comparison& comparison,
             const std::filesystem::path& font_folder = default_font_folder);

/// Draws the picture into a PNG file.
/// @throws scene::EnvironmentError  if it cannot be drawn or written; an older file then stays.
void write_picture(const std::filesystem::path& path, const analysis::Comparison& comparison);

/// The errors that a comparison's recommended constant bias leaves.
struct RecommendedErrors {
    const analysis::Recommendation* recommended; ///< the comparison's own; never null
    scene::Image<float> verdicts;                ///< 0 or 1, with the rounded recommended bias
};

/// Empty if verdicts at other biases are unknown or may be fractions, or if no bias is recommended
/// that leaves fewer errors.
[[nodiscard]] std::optional<RecommendedErrors>
recommended_errors(const analysis::Comparison& comparison);

} // namespace gnomon::reports
