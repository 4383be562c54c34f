#pragma once

#include "scene/light/light.hpp"

namespace gnomon::api {

/// The light as its numbers are, which `scene::make_light` rounds to float32.
/// @throws scene::InputError  as `scene::make_light` does.
[[nodiscard]] scene::Light make_light_of_doubles(const scene::LightSettings& settings);

} // namespace gnomon::api
