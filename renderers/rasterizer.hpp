#pragma once

#include "methods/polygon_offset.hpp"
#include "renderers/values.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/depth/offset_unit.hpp"
#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::renderers {

/// How a map is drawn, beside what its job and its view say.
struct MapRequest {
    bool keeps_triangles = false; ///< for `ShadowMap::triangles`
    /// Replaces the job's polygon offset; a factor and units of 0 draw without one.
    std::optional<methods::PolygonOffset> offset = {};
    /// Empty: all of them.
    std::optional<scene::TexelRows> rows = {};
};

/// What a filtered map's textures hold.
enum class FilteredContent : std::uint8_t {
    of_method, ///< what the method asks for
    float32,   ///< 32-bit floats in its place
};

/// Of each pixel the receiver's depth, in place of the one that the rasterizer computes; nullptr:
/// its own.
struct ReceiverDepths {
    const scene::Image<float>* own = nullptr;  ///< in the map that it reads
    const scene::Image<float>* next = nullptr; ///< in the map that is mixed in, where one is
};

/// What is looked up in what, and how: receivers in a map that the job's method can look up, with
/// the view's biases.
struct LookupRequest {
    const Drawn& drawn;
    const scene::Job& job;
    const scene::View& view;
    ReceiverDepths depths = {};
};

/// What draws what the camera and the light see, and looks the one up in the other.
///
/// Each call returns when its work is done, so that stages can be timed. No call depends on which
/// came before it. Not for several threads at once; what is drawn must end on the calls' thread.
/// A rasterizer that only looks up need not do the rest: it throws `std::logic_error` then.
class Rasterizer {
public:
    Rasterizer() = default;
    Rasterizer(const Rasterizer&) = delete;
    Rasterizer& operator=(const Rasterizer&) = delete;
    virtual ~Rasterizer() = default;

    [[nodiscard]] virtual int subpixel_bits() const = 0;
    /// @throws scene::InputError  if the driver lacks the image's size.
    [[nodiscard]] virtual std::shared_ptr<const Receivers>
    draw_receivers(const scene::View& view) = 0;
    /// @throws scene::InputError  if the driver lacks the map's format or size.
    [[nodiscard]] virtual std::shared_ptr<const ShadowMap>
    draw_map(const scene::Job& job, const scene::View& view, const MapRequest& request) = 0;
    /// Makes of a map that was drawn for the job what its method looks up.
    [[nodiscard]] virtual std::shared_ptr<const FilteredMap>
    filter_map(std::shared_ptr<const ShadowMap> map, const scene::Job& job, const scene::View& view,
               FilteredContent content);
    /// Stores these depths as a map of 32-bit floats, whatever format the job has, and filters it.
    [[nodiscard]] virtual std::shared_ptr<const FilteredMap>
    store_map(const scene::Job& job, const scene::View& view, const ExactDepths& depths);

    [[nodiscard]] virtual scene::LookupLayers look_up(const LookupRequest& request) = 0;
    /// What the view's biases beside constant and slope do to what `look_up` looks up. Empty: not
    /// known.
    [[nodiscard]] virtual std::optional<scene::LookupTerms>
    read_terms(const LookupRequest& request);
    /// The smallest constant bias of each pixel with which `look_up`'s verdict is at least
    /// `lit_from`, with the view's other biases: found by trying. 0 without a receiver.
    [[nodiscard]] virtual scene::Image<float> find_critical_biases(const LookupRequest& request,
                                                                   float lit_from);

    /// Where in a texel its samples are, of so many, from the texel's lower left [texels].
    [[nodiscard]] virtual std::vector<scene::Vec2d> sample_places(int samples);
    /// The driver's unit of polygon offset, measured at depths across [0, 1].
    [[nodiscard]] virtual std::vector<scene::OffsetUnit>
    measure_offset_units(scene::DepthFormat format);

    /// Gives back the memory of what has ended, which is kept so that what is drawn next is drawn
    /// faster.
    virtual void release_spares() {}
};

/// Draws the job's map and filters it.
[[nodiscard]] std::shared_ptr<const FilteredMap>
draw_filtered_map(Rasterizer& rasterizer, const scene::Job& job, const scene::View& view,
                  FilteredContent content = FilteredContent::of_method);

} // namespace gnomon::renderers
