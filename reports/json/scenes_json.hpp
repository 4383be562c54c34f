#pragma once

#include "scene/builtin/scenes.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The built-in scenes with every parameter (name, description, unit, default, and either its
/// range or its words) as the JSON array that `gnomon scenes --json` prints.
[[nodiscard]] std::string scenes_json(std::span<const scene::BuiltinScene> scenes);

} // namespace gnomon::reports
