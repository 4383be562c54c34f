#pragma once

#include "scene/job/file.hpp"

#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Each of the stages as results and documents spell it, in their order: "shadow_map".
[[nodiscard]] std::vector<std::string_view> stage_names(Stages stages);

} // namespace gnomon::scene
