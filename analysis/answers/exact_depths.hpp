#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/renderers.hpp"
#include "scene/image.hpp"
#include "scene/light/exact_light.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// The depths that exact rays find, rounded once to float32: of the texels that lookups read,
/// traced once and kept for every lookup of maps that differ in format or filter alone, and of the
/// scored receivers.
class ExactDepthCache {
public:
    /// @param maps  size of the image of all maps' texels (`scene::maps_image_size`).
    ExactDepthCache(scene::ImageSize maps, scene::ImageSize image);

    /// What the inputs' scored receivers and their footprints need; others keep what they have.
    /// @return  Valid as long as this.
    [[nodiscard]] ExactDepths of(const CauseInputs& inputs);

private:
    void want_texels(const CauseInputs& inputs);
    void trace_texels(const scene::ExactLight& light);
    void find_receivers(const CauseInputs& inputs);

    scene::Image<float> map_; ///< as shaders see it, top left first
    scene::Image<std::uint8_t> knows_texel_;
    scene::Image<float> receivers_;
    bool knows_receivers_ = false;
};

} // namespace gnomon::analysis
