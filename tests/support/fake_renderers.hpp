#pragma once

#include "analysis/renderers.hpp"
#include "scene/pixels/truth.hpp"

#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

namespace gnomon::tests {

/// A rasterizer made of callables. Its maps are empty.
class FakeRasterizer : public renderers::Rasterizer {
public:
    std::function<scene::ReceiverLayers(const scene::View&)> on_receivers =
        [](const scene::View& view) {
            return scene::ReceiverLayers{scene::Image<std::uint32_t>{view.image, 0}};
        };
    std::function<void()> on_map = [] {};
    std::function<scene::LookupLayers(const scene::Job&, const scene::View&)> on_look_up;
    int bits = 8;

    [[nodiscard]] int subpixel_bits() const override { return bits; }
    [[nodiscard]] std::shared_ptr<const renderers::Receivers>
    draw_receivers(const scene::View& view) override
    {
        return std::make_shared<Drawn>(on_receivers(view));
    }
    [[nodiscard]] std::shared_ptr<const renderers::ShadowMap>
    draw_map(const scene::Job& /*job*/, const scene::View& /*view*/,
             const renderers::MapRequest& /*request*/) override
    {
        on_map();
        return std::make_shared<Empty>();
    }
    [[nodiscard]] scene::LookupLayers look_up(const renderers::LookupRequest& request) override
    {
        return on_look_up(request.job, request.view);
    }

private:
    class Drawn final : public renderers::Receivers {
    public:
        explicit Drawn(scene::ReceiverLayers layers) : layers_{std::move(layers)} {}
        [[nodiscard]] scene::ReceiverLayers layers() const override { return layers_; }

    private:
        scene::ReceiverLayers layers_;
    };
    class Empty final : public renderers::ShadowMap {
    public:
        [[nodiscard]] scene::Image<float> depths() const override { return {}; }
    };
};

/// A reference without light queries.
class FakeReference : public renderers::Reference {
public:
    std::function<scene::Truth(const scene::View&, const scene::ReceiverLayers&)> on_truth;

    [[nodiscard]] scene::Truth find_truth(const scene::View& view,
                                          const scene::ReceiverLayers& receivers,
                                          const renderers::RasterFacts& /*raster*/) const override
    {
        return on_truth(view, receivers);
    }
    [[nodiscard]] bool has_light_queries() const override { return false; }
    [[nodiscard]] std::unique_ptr<renderers::LightQueries>
    make_light_queries(const scene::Job& /*job*/, const scene::View& /*view*/,
                       const scene::ReceiverLayers& /*receivers*/) const override
    {
        throw std::logic_error{"a fake reference has no light queries"};
    }
};

struct FakeRenderers {
    FakeRasterizer rasterizer;
    FakeReference reference;
    analysis::Environment environment;

    [[nodiscard]] analysis::Renderers renderers() { return {rasterizer, reference, environment}; }
};

} // namespace gnomon::tests
