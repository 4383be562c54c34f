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

/// Refuses a number beside maps of distances or linear depth, which do not change evenly over a
/// plane.
/// @throws scene::InputError  if the job has the key at another number than 0.
inline void refuse_distances(const scene::Job& job, std::string_view key)
{
    const scene::MapContent content = job.shadow_map.frustum.content;
    if (number_in(job, key) != 0 && content != scene::MapContent::depth) {
        throw scene::InputError(fmt::format("{} follows a plane's depth, and shadow_map.content is "
                                            "\"{}\"; remove one of them",
                                            key, scene::map_content_name(content)));
    }
}

} // namespace gnomon::methods
