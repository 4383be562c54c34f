#pragma once

#include "methods/bias_term.hpp"
#include "methods/gl_depth.hpp"
#include "methods/passes.hpp"

#include <string_view>

namespace gnomon::methods {

/// With it a piece of GLSL may call `plane_gradient` (raster_gl/shaders/lookup_map.glsl).
[[nodiscard]] inline Definition asks_for_plane_gradient()
{
    return {"PLANE_GRADIENT", "1"};
}

/// Refuses a map of anything but GL's own depth: nothing else changes evenly over a plane.
inline void require_depth_of_plane(const scene::Job& job, std::string_view key)
{
    require_gl_depth(
        job,
        "{1} follows a plane's depth, and shadow_map.content is \"{0}\"; remove one of "
        "them",
        key);
}

/// The same, of a key that holds a number.
/// @throws scene::InputError  if the job has the key at another number than 0.
inline void refuse_distances(const scene::Job& job, std::string_view key)
{
    if (number_in(job, key) != 0) {
        require_depth_of_plane(job, key);
    }
}

} // namespace gnomon::methods
