#pragma once

#include "scene/job/setting_layers.hpp"

#include <string_view>

namespace gnomon::scene {

/// Whether a key is for `layout = "cascades"` alone.
[[nodiscard]] bool is_cascade_key(std::string_view name);

/// Refuses what cascades cannot do, and their keys without them.
/// @throws InputError  naming the key.
void check_cascades(const Settings& settings);

} // namespace gnomon::scene
