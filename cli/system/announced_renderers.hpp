#pragma once

#include "analysis/renderers.hpp"
#include "cli/system/progress.hpp"
#include "renderers/forwarding.hpp"

namespace gnomon::cli {

/// Renderers that announce each slow stage to a `SlowWork`.
class AnnouncedRenderers {
public:
    /// Both arguments must outlive this.
    AnnouncedRenderers(const analysis::Renderers& own, SlowWork& work)
        : rasterizer_{own.rasterizer, work},
          reference_{own.reference, work},
          renderers_{rasterizer_, reference_, own.environment}
    {
    }

    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }

private:
    class Rasterizer final : public renderers::ForwardingRasterizer {
    public:
        Rasterizer(renderers::Rasterizer& own, SlowWork& work)
            : ForwardingRasterizer{own},
              work_{work}
        {
        }
        std::shared_ptr<const renderers::Receivers> draw_receivers(const scene::View& view) override
        {
            work_.now("drawing what the camera sees");
            return ForwardingRasterizer::draw_receivers(view);
        }
        std::shared_ptr<const renderers::ShadowMap>
        draw_map(const scene::Job& job, const scene::View& view,
                 const renderers::MapRequest& request) override
        {
            work_.now("drawing the shadow map");
            return ForwardingRasterizer::draw_map(job, view, request);
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            work_.now("looking the shadows up");
            return ForwardingRasterizer::look_up(request);
        }
        scene::Image<float> find_critical_biases(const renderers::LookupRequest& request,
                                                 float lit_from) override
        {
            work_.now("finding the bias curve by bisection");
            return ForwardingRasterizer::find_critical_biases(request, lit_from);
        }

    private:
        SlowWork& work_;
    };

    class Reference final : public renderers::ForwardingReference {
    public:
        Reference(const renderers::Reference& own, SlowWork& work)
            : ForwardingReference{own},
              work_{work}
        {
        }
        scene::Truth find_truth(const scene::View& view, const scene::ReceiverLayers& receivers,
                                const renderers::RasterFacts& raster) const override
        {
            work_.now("tracing the true shadows");
            return ForwardingReference::find_truth(view, receivers, raster);
        }
        std::unique_ptr<renderers::LightQueries>
        make_light_queries(const scene::Job& job, const scene::View& view,
                           const scene::ReceiverLayers& receivers) const override
        {
            work_.now("finding causes and the bias curve");
            return ForwardingReference::make_light_queries(job, view, receivers);
        }

    private:
        SlowWork& work_;
    };

    Rasterizer rasterizer_;
    Reference reference_;
    analysis::Renderers renderers_;
};

} // namespace gnomon::cli
