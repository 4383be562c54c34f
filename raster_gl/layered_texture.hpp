#pragma once

#include "raster_gl/gl_object.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::raster_gl {

/// A square texture with a layer for each of a light's maps: of one map a plain 2D texture, so that
/// shaders of one map need no layers; of several an array, each of whose layers is a 2D texture,
/// too.
class LayeredTexture {
public:
    LayeredTexture() = default;
    /// Immutable, sampled at the nearest texel of its first level.
    LayeredTexture(GLenum internal_format, int side_texels, std::size_t layers, int levels = 1);

    [[nodiscard]] bool empty() const { return all_.empty(); }
    [[nodiscard]] std::size_t layer_count() const { return is_array() ? layers_.size() : 1; }
    /// What lookups bind: 2D, or of several layers an array.
    [[nodiscard]] GLuint name() const { return all_.name(); }
    /// A layer as a 2D texture.
    [[nodiscard]] const Texture& layer(std::size_t i) const
    {
        return is_array() ? layers_.at(i) : all_;
    }

    /// The same six layers as a cube map, sampled across its seams where that is enabled; it must
    /// not outlive this.
    [[nodiscard]] Texture cube_view() const;

private:
    [[nodiscard]] bool is_array() const { return !layers_.empty(); }

    GLenum internal_format_ = 0;
    Texture all_;
    std::vector<Texture> layers_; ///< views of it; none of one layer
};

} // namespace gnomon::raster_gl
