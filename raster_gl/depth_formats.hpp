#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "scene/settings/job.hpp"

#include <string>
#include <vector>

namespace gnomon::raster_gl {

/// GL's internal format of the texture that holds a map, as lookups see it. What the shader
/// converts is kept as the float32 that its code stands for: of u-formats in a depth texture, of
/// colour formats in one of colours.
[[nodiscard]] GLenum internal_format(scene::DepthFormat format);

/// @throws scene::InputError  if the driver substitutes another format for `format` in `texture`.
void require_format(const Texture& texture, scene::DepthFormat format);

/// Whether this driver really has a format.
struct FormatSupport {
    std::string name; ///< "d16", "d24", "d32", "d32f"
    bool supported = false;
    std::string instead; ///< what it gives instead, e.g. "24 bits unorm"
};
[[nodiscard]] std::vector<FormatSupport> query_depth_formats(const Context& context);

} // namespace gnomon::raster_gl
