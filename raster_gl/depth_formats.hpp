#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "scene/job/job.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::raster_gl {

/// GL's internal format of the depth texture that holds a map: u-formats keep their quantised depth
/// in a float32 depth texture, beside the codes.
[[nodiscard]] GLenum internal_format(scene::DepthFormat format);

/// The largest code of a format of so many bits.
[[nodiscard]] constexpr std::uint32_t largest_code(scene::DepthFormat format)
{
    return static_cast<std::uint32_t>((std::uint64_t{1} << format.bits) - 1);
}

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
