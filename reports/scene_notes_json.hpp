#pragma once

#include "reports/json_values.hpp"
#include "scene/scene_notes.hpp"

#include <span>

namespace gnomon::reports {

/// An array of objects: `kind`, `count`, `text`.
[[nodiscard]] Json scene_notes_json(std::span<const scene::SceneNote> notes);

} // namespace gnomon::reports
