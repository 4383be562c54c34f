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

/// Depths found by exact rays, rounded once to float32, for the scored receivers and for the texels
/// that their lookups read. Texels are traced once and serve all maps that differ only in format or
/// filter.
class ExactDepthCache {
public:
    /// @param maps  Size of the image of all maps' texels (`scene::maps_image_size`).
    ExactDepthCache(scene::ImageSize maps, scene::ImageSize image);

    /// Provides the depths of the inputs' scored receivers and of their footprints; other elements
    /// keep their values.
    /// @param places  Positions within each texel (`LightQueries::texel_depths`); the centre alone
    ///                gives no samples.
    /// @param layers  2: adds the depths of the surface behind (`LightQueries::second_depths`) as
    ///                further samples; only at the centre.
    /// @return  Valid as long as this.
    [[nodiscard]] renderers::ExactDepths of(const CauseInputs& inputs,
                                            std::span<const scene::Vec2d> places, int layers);

private:
    /// Depths at some positions, equal for all texels.
    struct Traced {
        std::vector<scene::Vec2d> places;
        int layers = 1;
        std::vector<scene::Image<float>> depths; ///< by position or layer, as shaders see them
        scene::Image<std::uint8_t> knows_texel;
    };

    [[nodiscard]] Traced& traced_at(std::span<const scene::Vec2d> places, int layers);
    static void want_texels(const CauseInputs& inputs, scene::Image<std::uint8_t>& texels);
    static void trace(const renderers::LightQueries& light, Traced& traced);
    void find_receivers(const CauseInputs& inputs);
    void find_next_receivers(const CauseInputs& inputs);

    scene::ImageSize maps_;
    std::deque<Traced> traced_; ///< a deque, so that elements stay in place
    scene::Image<float> receivers_;
    scene::Image<float> next_receivers_; ///< in the next map, if it is blended in
    bool knows_receivers_ = false;
};

/// Exact depths with the bias terms that V2 keeps for lit pixels: receivers at P′, and texels moved
/// by a polygon offset.
class KeptDepths {
public:
    /// @param inputs  With terms.
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
