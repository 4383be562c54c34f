#pragma once

#include "reports/page/report_options.hpp"
#include "reports/page/run_overview.hpp"
#include "store/images/png.hpp"
#include "store/json.hpp"

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// Escapes a text for HTML content or a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

/// A right-aligned table cell with a number.
[[nodiscard]] std::string number_cell(std::string_view text);

[[nodiscard]] std::string row_heading(std::string_view text);

/// Opens a table up to its first row; `table_end` closes it.
/// @param columns  The first is the row heading, the others are numbers.
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::span<const std::string_view> columns);
[[nodiscard]] std::string table_head(std::string_view caption,
                                     std::initializer_list<std::string_view> columns);

inline constexpr std::string_view table_end = "</tbody></table></div>\n";

/// The whole page: a head whose Content-Security-Policy allows only its own style and scripts, the
/// body, data and scripts.
/// @param blocks  the packed texts "b0", "b1", ….
[[nodiscard]] std::string whole_page(std::string_view title, std::string_view body,
                                     const store::Json& data, std::span<const std::string> blocks);

/// A page without scripts: the head, then the body as given.
[[nodiscard]] std::string plain_page(std::string_view title, std::string_view body);

/// A picture with a caption at its left and a note at its right.
/// @param note  HTML.
[[nodiscard]] std::string picture_figure(const HeadlinePicture& picture, std::string_view caption,
                                         std::string_view note);

/// Errors by object in HTML, most errors first, or why they are unknown.
/// @param detail  The output of `compare --json`; null if it was not kept.
[[nodiscard]] std::string objects_table(const store::Json& detail);

/// Errors by map, and the range of each cascade; empty for a light with one map.
[[nodiscard]] std::string maps_table(const store::Json& detail, std::string_view unit);

/// The size to which a picture of the first screen is scaled.
[[nodiscard]] scene::ImageSize page_picture_size(scene::ImageSize image);

/// Writes a picture into DIR/pictures.
/// @param name  of the file, without ".png".
/// @param alt   alternative text.
/// @throws scene::EnvironmentError  if the file cannot be written.
[[nodiscard]] HeadlinePicture write_page_picture(const store::RgbImage& image,
                                                 std::string_view name, std::string alt,
                                                 const std::filesystem::path& out);

/// Draws the headline configuration's pictures from its layers, and writes them into DIR/pictures.
/// @return  Three pictures, or none if its layers were not kept or are damaged.
/// @throws scene::EnvironmentError  if a file cannot be written.
[[nodiscard]] std::vector<HeadlinePicture> headline_pictures(const store::RunReader& run,
                                                             const RunOverview& overview,
                                                             const std::filesystem::path& out);

/// The first remedy: "a constant bias of 0.078 m, 4.8 texels → 0.44 % wrong"; empty if none is
/// known.
/// @param detail  The configuration's kept JSON; may be null.
[[nodiscard]] std::string first_fix(const store::Json& detail, std::string_view unit);

/// The card with the fix and its settings for each target, and the card with all remedies.
/// @param overview  with a headline and its detail.
[[nodiscard]] std::string fix_cards(const store::RunReader& run, const RunOverview& overview);

/// What is wrong, by how much and what to do, with pictures.
/// @param pictures  three, or none.
/// @param below     HTML at its end.
[[nodiscard]] std::string first_screen(const store::RunReader& run, const RunOverview& overview,
                                       std::span<const HeadlinePicture> pictures,
                                       const std::string& below);

/// A run and its overview, which has a headline.
struct ComparedRun {
    const store::RunReader& run;
    const RunOverview& overview;
};

/// What changed between the headlines of two runs: settings, results and pixels. Draws
/// DIR/pictures/changed.png if both kept their pixels and the images have one size.
/// @throws scene::EnvironmentError  if the picture cannot be written.
[[nodiscard]] std::string against_section(const ComparedRun& before, const ComparedRun& now,
                                          const std::filesystem::path& out);

/// The parts of a page that are made before its body.
struct PageParts {
    std::vector<HeadlinePicture> headline; ///< three pictures, or none
    std::vector<std::string> figures;      ///< data: URLs, in the figures' order
    std::string against;                   ///< HTML of `against_section`; may be empty
};

/// The part of a page that works without JavaScript: from the navigation to the end of main.
[[nodiscard]] std::string page_body(const store::RunReader& run, const RunOverview& overview,
                                    const ReportOptions& options, const PageParts& parts);

} // namespace gnomon::reports
