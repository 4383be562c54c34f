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

/// What a rasterizer did, as far as the explanation of unmatched pixels needs it.
struct RasterFacts {
    int subpixel_bits = 8;
    /// Its own clip positions of the scene's vertices; empty: they are known only up to the
    /// rounding of a float32 transform.
    std::vector<scene::Vec4f> clip_positions;
};

/// What the camera sees, drawn. Its memory is given back when it ends; it must not outlive its
/// rasterizer.
class Receivers {
public:
    Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    virtual ~Receivers() = default;

    /// Read anew by each call.
    [[nodiscard]] virtual scene::ReceiverLayers layers() const = 0;
    [[nodiscard]] virtual RasterFacts raster_facts() const { return {}; }
};

/// A light's map, or its several ones, drawn or stored; of a method without a map there is nothing
/// in it. Its memory is given back when it ends; it must not outlive its rasterizer.
class ShadowMap {
public:
    ShadowMap() = default;
    ShadowMap(const ShadowMap&) = delete;
    ShadowMap& operator=(const ShadowMap&) = delete;
    virtual ~ShadowMap() = default;

    /// As shaders see them (`scene::maps_image_size`); of a map of some rows 0 in the others.
    [[nodiscard]] virtual scene::Image<float> depths() const = 0;
    /// That each texel shows, or `scene::no_triangle` (`scene::maps_image_size`).
    /// @throws std::invalid_argument  if the map was drawn without them.
    [[nodiscard]] virtual scene::Image<std::uint32_t> triangles() const;
};

/// A map, and what a method made of it to look up; of most methods that is the map alone.
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

/// What lookups need: both of one rasterizer.
struct Drawn {
    std::shared_ptr<const Receivers> receivers;
    std::shared_ptr<const FilteredMap> map;
};

/// Depths that exact rays find, rounded once to float32.
struct ExactDepths {
    const scene::Image<float>& map;       ///< of texels, as shaders see them (`maps_image_size`)
    const scene::Image<float>& receivers; ///< of pixels
    const scene::Image<float>& next_receivers; ///< in the map that is mixed in; empty: none is
    /// Like `map`, of each sample of the texels; empty where the method asks for one, the centre.
    std::span<const scene::Image<float>> samples;
};

} // namespace gnomon::renderers
