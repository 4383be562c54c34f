#pragma once

#include "methods/bias_term.hpp"
#include "methods/passes.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <string_view>

namespace gnomon::methods {

/// With it a piece of GLSL may call `plane_gradient` (raster_gl/shaders/lookup_map.glsl).
[[nodiscard]] inline Definition asks_for_plane_gradient()
{
    return {"PLANE_GRADIENT", "1"};
}

/// Refuses a number beside maps of distances, which do not change evenly over a plane.
/// @throws scene::InputError  if the job has the key at another number than 0.
inline void refuse_distances(const scene::Job& job, std::string_view key)
{
    if (number_in(job, key) != 0 && job.shadow_map.frustum.content == scene::MapContent::distance) {
        throw scene::InputError(fmt::format("{} follows a plane's depth, and shadow_map.content is "
                                            "\"distance\"; remove one of them",
                                            key));
    }
}

} // namespace gnomon::methods
