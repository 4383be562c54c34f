#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::renderers {

/// Facts about a rasterizer that explain unmatched pixels.
struct RasterFacts {
    int subpixel_bits = 8;
    /// The rasterizer's clip position of each vertex; empty if known only up to the rounding of a
    /// float32 transform.
    std::vector<scene::Vec4f> clip_positions;
};

/// The camera's receivers, drawn. Must not outlive its rasterizer, which reuses its memory.
class Receivers {
public:
    Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    virtual ~Receivers() = default;

    /// Reads the layers back on each call.
    [[nodiscard]] virtual scene::ReceiverLayers layers() const = 0;
    [[nodiscard]] virtual RasterFacts raster_facts() const { return {}; }
};

/// A light's map or maps, drawn or stored; empty if the method has no map. Must not outlive its
/// rasterizer, which reuses its memory.
class ShadowMap {
public:
    ShadowMap() = default;
    ShadowMap(const ShadowMap&) = delete;
    ShadowMap& operator=(const ShadowMap&) = delete;
    virtual ~ShadowMap() = default;

    /// Depths as shaders read them (`scene::maps_image_size`); 0 in rows that were not drawn.
    [[nodiscard]] virtual scene::Image<float> depths() const = 0;
    /// The triangle of each texel, or `scene::no_triangle` (`scene::maps_image_size`).
    /// @throws std::invalid_argument  if the map was drawn without triangles.
    [[nodiscard]] virtual scene::Image<std::uint32_t> triangles() const;
};

/// A map and its prefiltered form; most methods look up the map itself.
class FilteredMap {
public:
    explicit FilteredMap(std::shared_ptr<const ShadowMap> map) : map_{std::move(map)} {}
    FilteredMap(const FilteredMap&) = delete;
    FilteredMap& operator=(const FilteredMap&) = delete;
    virtual ~FilteredMap() = default;

    [[nodiscard]] const ShadowMap& map() const { return *map_; }

private:
    std::shared_ptr<const ShadowMap> map_;
};

/// The inputs of a lookup, both from one rasterizer.
struct Drawn {
    std::shared_ptr<const Receivers> receivers;
    std::shared_ptr<const FilteredMap> map;
};

/// Depths from exact rays, rounded once to float32.
struct ExactDepths {
    const scene::Image<float>& map;       ///< of texels, as shaders read them (`maps_image_size`)
    const scene::Image<float>& receivers; ///< of pixels
    const scene::Image<float>& next_receivers; ///< in the map that is blended in; empty if none
    /// Like `map`, for each sample of a texel; empty if the method samples the centre only.
    std::span<const scene::Image<float>> samples;
};

} // namespace gnomon::renderers
