#pragma once

#include "renderers/rasterizer.hpp"
#include "renderers/reference.hpp"

#include <utility>

namespace gnomon::renderers {

/// Forwards each call to another rasterizer; derive from it to override some.
class ForwardingRasterizer : public Rasterizer {
public:
    /// @param own  that answers; it must outlive this.
    explicit ForwardingRasterizer(Rasterizer& own) : own_{own} {}

    [[nodiscard]] int subpixel_bits() const override { return own_.subpixel_bits(); }
    [[nodiscard]] std::shared_ptr<const Receivers> draw_receivers(const scene::View& view) override
    {
        return own_.draw_receivers(view);
    }
    [[nodiscard]] std::shared_ptr<const ShadowMap>
    draw_map(const scene::Job& job, const scene::View& view, const MapRequest& request) override
    {
        return own_.draw_map(job, view, request);
    }
    [[nodiscard]] std::shared_ptr<const FilteredMap>
    filter_map(std::shared_ptr<const ShadowMap> map, const scene::Job& job, const scene::View& view,
               FilteredContent content) override
    {
        return own_.filter_map(std::move(map), job, view, content);
    }
    [[nodiscard]] std::shared_ptr<const FilteredMap>
    store_map(const scene::Job& job, const scene::View& view, const ExactDepths& depths) override
    {
        return own_.store_map(job, view, depths);
    }
    [[nodiscard]] scene::LookupLayers look_up(const LookupRequest& request) override
    {
        return own_.look_up(request);
    }
    [[nodiscard]] std::optional<scene::LookupTerms>
    read_terms(const LookupRequest& request) override
    {
        return own_.read_terms(request);
    }
    [[nodiscard]] scene::Image<float> find_critical_biases(const LookupRequest& request,
                                                           float lit_from) override
    {
        return own_.find_critical_biases(request, lit_from);
    }
    [[nodiscard]] std::vector<scene::Vec2d> sample_places(int samples) override
    {
        return own_.sample_places(samples);
    }
    [[nodiscard]] std::vector<scene::OffsetUnit>
    measure_offset_units(scene::DepthFormat format) override
    {
        return own_.measure_offset_units(format);
    }
    void release_spares() override { own_.release_spares(); }

private:
    Rasterizer& own_;
};

/// Forwards each call to another reference.
class ForwardingReference : public Reference {
public:
    /// @param own  that answers; it must outlive this.
    explicit ForwardingReference(const Reference& own) : own_{own} {}

    [[nodiscard]] scene::Truth find_truth(const scene::View& view,
                                          const scene::ReceiverLayers& receivers,
                                          const RasterFacts& raster) const override
    {
        return own_.find_truth(view, receivers, raster);
    }
    [[nodiscard]] std::string truth_method() const override { return own_.truth_method(); }
    [[nodiscard]] bool has_light_queries() const override { return own_.has_light_queries(); }
    [[nodiscard]] std::unique_ptr<LightQueries>
    make_light_queries(const scene::Job& job, const scene::View& view,
                       const scene::ReceiverLayers& receivers) const override
    {
        return own_.make_light_queries(job, view, receivers);
    }

private:
    const Reference& own_;
};

} // namespace gnomon::renderers
