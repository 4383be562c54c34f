#pragma once

#include "methods/polygon_offset.hpp"
#include "scene/depth/offset_unit.hpp"
#include "scene/job/job.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// What computed a result; part of every result.
struct Environment {
    std::string gl_renderer;
    std::string gl_version;
    std::string embree;
    std::string gnomon;

    /// Stands for GL's version where a case says what drew its mask.
    static constexpr std::string_view other_renderer = "another renderer";
    [[nodiscard]] bool is_of_gl() const { return gl_version != other_renderer; }
};

/// Depths that exact rays find, rounded once to float32.
struct ExactDepths {
    const scene::Image<float>& map;       ///< of texels, as shaders see them (`maps_image_size`)
    const scene::Image<float>& receivers; ///< of pixels
    const scene::Image<float>& next_receivers; ///< in the map that is mixed in; empty: none is
    /// Like `map`, of each sample of the texels; empty where the method asks for one, the centre.
    std::span<const scene::Image<float>> samples;
};

/// A light's maps of 32-bit floats, as images of all their texels (`scene::maps_image_size`).
struct DrawnFloats {
    scene::Image<float> depths;            ///< as shaders see them
    scene::Image<std::uint32_t> triangles; ///< that each texel shows, or `no_triangle`
};

/// What a prefilter's textures hold.
enum class FilteredContent : std::uint8_t {
    of_method, ///< what the method asks for
    float32,   ///< 32-bit floats in its place
};

/// The two renderers as callables, one for each stage, so that `analysis` needs neither GL nor
/// Embree and a sweep can call just the stages whose inputs changed.
///
/// Each returns when its work is done: an asynchronous renderer waits, so that stages can be timed.
/// `look_up` answers for the receivers selected and the shadow map drawn last, which the renderer
/// keeps.
struct Renderers {
    std::function<scene::ReceiverLayers(const scene::View&)> draw_receivers;
    /// Which of several receivers, kept side by side, `draw_receivers` draws and `look_up` reads;
    /// the first until this is called. Empty: there is but one.
    std::function<void(std::size_t slot)> select_receivers;
    std::function<void(const scene::Job&, const scene::View&)> draw_shadow_map;
    /// Makes of the map drawn last what the job's method looks up. Empty: methods that make nothing
    /// of it are the only ones.
    std::function<void(const scene::Job&, const scene::View&, FilteredContent)> prefilter_map;
    /// Where in a texel GL's samples are, of so many, from the texel's lower left [texels]. Empty:
    /// methods that ask for one, the centre, are the only ones.
    std::function<std::vector<scene::Vec2d>(int samples)> sample_places;
    std::function<scene::LookupLayers(const scene::Job&, const scene::View&)> look_up;
    /// What the view's biases beside constant and slope do to what `look_up` looks up. Empty: not
    /// known.
    std::function<scene::LookupTerms(const scene::Job&, const scene::View&)> read_terms;
    /// The smallest constant bias of each pixel with which `look_up` lights it, of the same
    /// receivers and map, with the view's other biases: found by trying. 0 without a
    /// receiver. Empty: what no formula tells of other biases is not known.
    std::function<scene::Image<float>(const scene::Job&, const scene::View&)> find_critical_biases;
    /// The same of a map of exact depths, with 32-bit floats whatever the method asks for, and of
    /// receivers of exact depths, where the view's other biases look them up: for each of
    /// `lit_from` the smallest bias with which the verdict is no less. What was drawn and
    /// prefiltered last is lost. Empty: methods that compare depths are the only ones.
    std::function<std::vector<scene::Image<float>>(
        const scene::Job&, const scene::View&, const ExactDepths&, std::span<const float> lit_from)>
        find_exact_critical_biases;
    /// The verdicts of such lookups with each of the biases, where no bias can be found by trying.
    /// What was drawn and prefiltered last is lost. Empty: there are no such methods.
    std::function<std::vector<scene::Image<float>>(const scene::Job&, const scene::View&,
                                                   const ExactDepths&,
                                                   std::span<const scene::Bias> biases)>
        look_up_exactly;
    std::function<scene::Truth(const scene::View&, const scene::ReceiverLayers&)> find_truth;
    /// The depths of the maps drawn last, as shaders see them (`scene::maps_image_size`).
    std::function<scene::Image<float>()> read_map_depths;
    /// Gives the memory of the map drawn last back: it is drawn again before it is asked again.
    /// Empty: there is nothing to give back.
    std::function<void()> forget_shadow_map;
    /// Those of some rows of the same map drawn as d32f; the map drawn last is lost.
    std::function<scene::Image<float>(const scene::Job&, const scene::View&, scene::TexelRows)>
        read_float_depths;
    /// The same map drawn as d32f with this polygon offset, and what it shows; the map drawn last
    /// is lost. Empty: what an offset does to a map is not known.
    std::function<DrawnFloats(const scene::Job&, const scene::View&,
                              const std::optional<methods::PolygonOffset>&)>
        draw_floats;
    /// The driver's unit of polygon offset, measured at depths across [0, 1]. What was drawn last
    /// stays. Empty: what an offset is long is not told.
    std::function<std::vector<scene::OffsetUnit>(scene::DepthFormat)> measure_offset_units;
    /// Empty: errors stay without a diagnosis. What it makes may refer to its arguments.
    std::function<std::unique_ptr<scene::ExactLight>(const scene::Job&, const scene::View&,
                                                     const scene::ReceiverLayers&)>
        make_exact_light;

    /// Draws the job's map, and makes of it what the job's method looks up.
    void draw_map(const scene::Job& job, const scene::View& view) const
    {
        draw_shadow_map(job, view);
        if (prefilter_map) {
            prefilter_map(job, view, FilteredContent::of_method);
        }
    }

    Environment environment;
    std::string truth_method; ///< the name of the method behind `find_truth`, e.g. "exact"
    int subpixel_bits = 8;    ///< of the rasteriser behind `draw_receivers`
};

} // namespace gnomon::analysis
