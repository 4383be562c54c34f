#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "renderers/light_queries.hpp"
#include "renderers/values.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The depths that exact rays find, rounded once to float32: of the texels that lookups read,
/// traced once and kept for every lookup of maps that differ in format or filter alone, and of the
/// scored receivers.
class ExactDepthCache {
public:
    /// @param maps  size of the image of all maps' texels (`scene::maps_image_size`).
    ExactDepthCache(scene::ImageSize maps, scene::ImageSize image);

    /// What the inputs' scored receivers and their footprints need; others keep what they have.
    /// @param places  in each texel (`LightQueries::texel_depths`); the centre alone: no samples.
    /// @param layers  2: with the depths of what lies behind (`LightQueries::second_depths`), as if
    ///                those were other samples; at the centre alone.
    /// @return  Valid as long as this.
    [[nodiscard]] renderers::ExactDepths of(const CauseInputs& inputs,
                                            std::span<const scene::Vec2d> places, int layers);

private:
    /// Depths at some places of texels, the same of all.
    struct Traced {
        std::vector<scene::Vec2d> places;
        int layers = 1;
        std::vector<scene::Image<float>> depths; ///< by place or layer, as shaders see them
        scene::Image<std::uint8_t> knows_texel;
    };

    [[nodiscard]] Traced& traced_at(std::span<const scene::Vec2d> places, int layers);
    static void want_texels(const CauseInputs& inputs, scene::Image<std::uint8_t>& texels);
    static void trace(const renderers::LightQueries& light, Traced& traced);
    void find_receivers(const CauseInputs& inputs);
    void find_next_receivers(const CauseInputs& inputs);

    scene::ImageSize maps_;
    std::deque<Traced> traced_; ///< those that are there stay where they are
    scene::Image<float> receivers_;
    scene::Image<float> next_receivers_; ///< in the next map, where one is mixed in
    bool knows_receivers_ = false;
};

/// The same with the bias terms that V2 keeps for lit pixels: the depths of P′, and those of texels
/// with what a polygon offset adds to them.
class KeptDepths {
public:
    /// @param inputs  with terms.
    KeptDepths(const renderers::ExactDepths& depths, const CauseInputs& inputs);

    /// Valid as long as this.
    [[nodiscard]] renderers::ExactDepths depths() const
    {
        return {map_, receivers_, next_receivers_, samples_};
    }

private:
    scene::Image<float> map_;
    scene::Image<float> receivers_; ///< of lit pixels
    scene::Image<float> next_receivers_;
    std::vector<scene::Image<float>> samples_;
};

} // namespace gnomon::analysis
