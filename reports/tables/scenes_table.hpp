#pragma once

#include "scene/builtin/scenes.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The built-in scenes and their parameters as the aligned text that `gnomon scenes` prints.
[[nodiscard]] std::string scenes_table(std::span<const scene::BuiltinScene> scenes);

} // namespace gnomon::reports
