#pragma once

#include "methods/polygon_offset.hpp"
#include "renderers/values.hpp"
#include "scene/depth/depth_format.hpp"
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

/// Options for drawing a map, beside its job and view.
struct MapRequest {
    bool keeps_triangles = false; ///< for `ShadowMap::triangles`
    /// Replaces the job's polygon offset; factor 0 and units 0 mean no offset.
    std::optional<methods::PolygonOffset> offset = {};
    /// Empty for all rows.
    std::optional<scene::TexelRows> rows = {};
};

/// The texel content of a filtered map.
enum class FilteredContent : std::uint8_t {
    of_method, ///< the method's format
    float32,   ///< 32-bit floats instead
};

/// Receiver depths per pixel to use instead of the rasterizer's; null to compute them.
struct ReceiverDepths {
    const scene::Image<float>* own = nullptr;  ///< in the map that it reads
    const scene::Image<float>* next = nullptr; ///< in the map that is blended in, if any
};

/// A lookup of receivers in a map, by the job's method, with the view's biases.
struct LookupRequest {
    const Drawn& drawn;
    const scene::Job& job;
    const scene::View& view;
    ReceiverDepths depths = {};
};

/// Draws the camera's receivers and the light's maps, and looks up receivers in maps.
///
/// Calls are synchronous, so that stages can be timed, and independent of earlier calls. Not
/// thread-safe: destroy drawn values on the calling thread. A rasterizer that only supports lookups
/// throws `std::logic_error` from the other calls.
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
    /// Filters a map that was drawn for the job, as its method requires.
    [[nodiscard]] virtual std::shared_ptr<const FilteredMap>
    filter_map(std::shared_ptr<const ShadowMap> map, const scene::Job& job, const scene::View& view,
               FilteredContent content);
    /// Stores the given depths as a map of 32-bit floats, in place of the job's format, and filters
    /// it.
    [[nodiscard]] virtual std::shared_ptr<const FilteredMap>
    store_map(const scene::Job& job, const scene::View& view, const ExactDepths& depths);

    [[nodiscard]] virtual scene::LookupLayers look_up(const LookupRequest& request) = 0;
    /// The effect of the view's biases other than constant and slope on `look_up`; empty if
    /// unknown.
    [[nodiscard]] virtual std::optional<scene::LookupTerms>
    read_terms(const LookupRequest& request);
    /// The smallest constant bias per pixel for which `look_up`'s verdict reaches `lit_from`, with
    /// the view's other biases, found by bisection; 0 without a receiver.
    [[nodiscard]] virtual scene::Image<float> find_critical_biases(const LookupRequest& request,
                                                                   float lit_from);

    /// The sample positions of a multisampled texel, from its lower left [texels].
    [[nodiscard]] virtual std::vector<scene::Vec2d> sample_places(int samples);
    /// Measures the driver's unit of polygon offset at depths across [0, 1].
    [[nodiscard]] virtual std::vector<scene::OffsetUnit>
    measure_offset_units(scene::DepthFormat format);

    /// Frees textures kept for reuse.
    virtual void release_spares() {}
};

/// Draws the job's map and filters it.
[[nodiscard]] std::shared_ptr<const FilteredMap>
draw_filtered_map(Rasterizer& rasterizer, const scene::Job& job, const scene::View& view,
                  FilteredContent content = FilteredContent::of_method);

} // namespace gnomon::renderers
