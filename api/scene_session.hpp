#pragma once

#include "analysis/renderers.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/rasterizer.hpp"
#include "reference_rt/reference.hpp"
#include "reference_rt/reference_scene.hpp"
#include "renderers/forwarding.hpp"
#include "scene/geometry/triangles.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace gnomon::api {

/// What both renderers are opened with.
struct SessionOptions {
    std::optional<int> device; ///< EGL device, as `gnomon doctor` numbers them
    int threads = 0;           ///< of the reference; 0: all cores
    reference_rt::TruthMethod method = reference_rt::TruthMethod::exact;
    bool audits = false; ///< float methods will be audited
    /// A context for a whole session, current on its thread; null: it opens its own.
    std::shared_ptr<const raster_gl::Context> context = {};
    /// Empty, or asked before GL draws or looks up; what it throws ends the work.
    std::function<void()> check_interruption = {};
};

/// The context that the options have, or a new one, current on the calling thread.
/// @throws scene::EnvironmentError  as `raster_gl::Context` does.
[[nodiscard]] std::shared_ptr<const raster_gl::Context> opened(const SessionOptions& options);

/// A scene that both renderers have loaded.
class SceneSession {
public:
    /// The context and the triangles must outlive this.
    /// @throws scene::EnvironmentError  if GL or Embree fails.
    SceneSession(const raster_gl::Context& context, const scene::TriangleScene& triangles,
                 const SessionOptions& options);

    [[nodiscard]] const reference_rt::ReferenceScene& reference() const { return scene_; }
    /// Valid as long as this.
    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }
    [[nodiscard]] double bvh_seconds() const { return bvh_s_; }

private:
    /// GL, but for asking first.
    class Rasterizer final : public renderers::ForwardingRasterizer {
    public:
        Rasterizer(renderers::Rasterizer& own, std::function<void()> check_interruption)
            : ForwardingRasterizer{own},
              check_interruption_{std::move(check_interruption)}
        {
        }
        std::shared_ptr<const renderers::Receivers> draw_receivers(const scene::View& view) override
        {
            check();
            return ForwardingRasterizer::draw_receivers(view);
        }
        std::shared_ptr<const renderers::ShadowMap>
        draw_map(const scene::Job& job, const scene::View& view,
                 const renderers::MapRequest& request) override
        {
            check();
            return ForwardingRasterizer::draw_map(job, view, request);
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            check();
            return ForwardingRasterizer::look_up(request);
        }

    private:
        void check() const
        {
            if (check_interruption_) {
                check_interruption_();
            }
        }

        std::function<void()> check_interruption_;
    };

    double bvh_s_ = 0;
    raster_gl::GlRasterizer gl_;
    Rasterizer rasterizer_;
    reference_rt::ReferenceScene scene_;
    reference_rt::EmbreeReference reference_;
    analysis::Renderers renderers_;
};

} // namespace gnomon::api
