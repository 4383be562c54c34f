#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/lookup.hpp"
#include "raster_gl/map/depth_peeling.hpp"
#include "raster_gl/map/multisampled_depth.hpp"
#include "raster_gl/map/prefilter.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "raster_gl/receivers.hpp"
#include "raster_gl/shadow_volumes.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/geometry/triangles.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::raster_gl {

/// The GL rasterizer for one scene.
class GlRasterizer final : public renderers::Rasterizer {
public:
    /// Both arguments must outlive this object.
    GlRasterizer(const Context& context, const scene::TriangleScene& triangles);

    [[nodiscard]] int subpixel_bits() const override { return context_.facts().subpixel_bits; }
    [[nodiscard]] std::shared_ptr<const renderers::Receivers>
    draw_receivers(const scene::View& view) override;
    [[nodiscard]] std::shared_ptr<const renderers::ShadowMap>
    draw_map(const scene::Job& job, const scene::View& view,
             const renderers::MapRequest& request) override;
    [[nodiscard]] std::shared_ptr<const renderers::FilteredMap>
    filter_map(std::shared_ptr<const renderers::ShadowMap> map, const scene::Job& job,
               const scene::View& view, renderers::FilteredContent content) override;
    [[nodiscard]] std::shared_ptr<const renderers::FilteredMap>
    store_map(const scene::Job& job, const scene::View& view,
              const renderers::ExactDepths& depths) override;
    [[nodiscard]] scene::LookupLayers look_up(const renderers::LookupRequest& request) override;
    [[nodiscard]] std::optional<scene::LookupTerms>
    read_terms(const renderers::LookupRequest& request) override;
    [[nodiscard]] scene::Image<float> find_critical_biases(const renderers::LookupRequest& request,
                                                           float lit_from) override;
    [[nodiscard]] std::vector<scene::Vec2d> sample_places(int samples) override;
    [[nodiscard]] std::vector<scene::OffsetUnit>
    measure_offset_units(scene::DepthFormat format) override;
    void release_spares() override;

private:
    class DrawnReceivers;
    class DrawnMap;
    class PrefilteredMap;

    /// Unwraps drawn values for the lookup pass.
    /// @throws std::invalid_argument  if another rasterizer drew them, or the map is empty.
    [[nodiscard]] LookupSource looked_up(const renderers::Drawn& drawn) const;
    /// Runs the prefilter of the job's method over a map or its sampled depths.
    [[nodiscard]] std::shared_ptr<const renderers::FilteredMap>
    prefiltered(std::shared_ptr<const DrawnMap> map, const scene::Job& job,
                renderers::FilteredContent content, const SampledDepths& samples);

    const Context& context_;
    scene::Box box_;
    GpuScene scene_;
    ReceiverPass receiver_pass_;
    ShadowMapPass shadow_map_pass_;
    MultisampledDepth multisampled_depth_;
    DepthPeeling depth_peeling_;
    PrefilterPass prefilter_pass_;
    LookupPass lookup_pass_;
    ShadowVolumePass volume_pass_;
};

} // namespace gnomon::raster_gl
