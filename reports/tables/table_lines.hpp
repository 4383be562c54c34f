#pragma once

#include "scene/load/scene_notes.hpp"

#include <span>
#include <string>
#include <string_view>

/// Lines of the tables that `gnomon compare` prints.
namespace gnomon::reports {

/// "light           spot, cone 60 deg"
[[nodiscard]] std::string setting_line(std::string_view name, std::string_view value);

/// "lit                   43,270     4.70 %  scored"
[[nodiscard]] std::string count_line(std::string_view name, std::string_view count,
                                     std::string_view rate, std::string_view note);

/// "-- light sun ------…", above what is said of one of several.
[[nodiscard]] std::string heading_line(std::string_view words);

/// A line for each note on the scene.
[[nodiscard]] std::string note_lines(std::span<const scene::SceneNote> notes);

/// "slope-curve" of `slope_curve`: a name as tables show it.
[[nodiscard]] std::string shown_name(std::string_view name);

} // namespace gnomon::reports
