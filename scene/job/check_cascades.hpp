#pragma once

#include "scene/job/setting_layers.hpp"

namespace gnomon::scene {

/// Refuses what cascades cannot do, and their keys without them.
/// @throws InputError  naming the key.
void check_cascades(const Settings& settings);

} // namespace gnomon::scene
