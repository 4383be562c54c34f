#pragma once

#include "scene/load/scene_notes.hpp"
#include "store/json.hpp"

#include <span>

namespace gnomon::reports {

/// An array of objects: `kind`, `count`, `text`.
[[nodiscard]] store::Json scene_notes_json(std::span<const scene::SceneNote> notes);

} // namespace gnomon::reports
