#pragma once

#include "scene/load/scene_notes.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Lines of the text tables that commands print.
namespace gnomon::reports {

/// "light           spot, cone 60 deg"
[[nodiscard]] std::string setting_line(std::string_view name, std::string_view value);

/// "lit                   43,270     4.70 %  scored"
[[nodiscard]] std::string count_line(std::string_view name, std::string_view count,
                                     std::string_view rate, std::string_view note);

/// "-- light sun ------…": the heading of one light's table.
[[nodiscard]] std::string heading_line(std::string_view words);

/// A line for each note on the scene.
[[nodiscard]] std::string note_lines(std::span<const scene::SceneNote> notes);

/// A name as tables show it: "slope-curve" for `slope_curve`.
[[nodiscard]] std::string shown_name(std::string_view name);

/// Rows as aligned, indented columns after an empty line; empty if there is only a heading.
/// @param rows  The heading first; all with as many cells as it has.
[[nodiscard]] std::string aligned_rows(const std::vector<std::vector<std::string>>& rows);

} // namespace gnomon::reports
