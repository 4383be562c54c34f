#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::raster_gl {

/// GL's internal format of the texture that lookups sample. Formats that the shader converts are
/// stored as the float32 value of their code: u-formats in a depth texture, colour formats in a
/// colour texture.
[[nodiscard]] GLenum internal_format(scene::DepthFormat format);

/// @throws scene::InputError  if the driver stores `texture` in another format.
void require_format(const Texture& texture, scene::DepthFormat format);

/// Whether the driver stores a format as requested.
struct FormatSupport {
    std::string name; ///< "d16", "d24", "d32", "d32f"
    bool supported = false;
    std::string instead; ///< what the driver stores instead, e.g. "24 bits unorm"
};
[[nodiscard]] std::vector<FormatSupport> query_depth_formats(const Context& context);

/// A square texture with a layer for each of a light's maps. A single map is a plain 2D texture, so
/// its shaders need no layers. Several maps are an array, with a 2D view of each layer.
class LayeredTexture {
public:
    LayeredTexture() = default;
    /// Immutable, sampled at the nearest texel of its first level.
    LayeredTexture(GLenum internal_format, int side_texels, std::size_t layers, int levels = 1);

    [[nodiscard]] bool empty() const { return all_.empty(); }
    [[nodiscard]] std::size_t layer_count() const { return is_array() ? layers_.size() : 1; }
    /// The texture that lookups bind: 2D, or an array if there are several layers.
    [[nodiscard]] GLuint name() const { return all_.name(); }
    /// A layer as a 2D texture.
    [[nodiscard]] const Texture& layer(std::size_t i) const
    {
        return is_array() ? layers_.at(i) : all_;
    }

    /// A cube-map view of the six layers; it must not outlive this object.
    [[nodiscard]] Texture cube_view() const;

private:
    [[nodiscard]] bool is_array() const { return !layers_.empty(); }

    GLenum internal_format_ = 0;
    Texture all_;
    std::vector<Texture> layers_; ///< 2D views of an array; empty for a single layer
};

} // namespace gnomon::raster_gl
