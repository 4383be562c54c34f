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

/// Options for opening both renderers.
struct SessionOptions {
    std::optional<int> device; ///< EGL device, as `gnomon doctor` numbers them
    int threads = 0;           ///< of the reference; 0 for all cores
    reference_rt::TruthMethod method = reference_rt::TruthMethod::exact;
    bool audits = false; ///< whether float methods will be audited
    /// A context, current on the session's thread; null to open a new one.
    std::shared_ptr<const raster_gl::Context> context = {};
    /// If set, called before GL draws or looks up; an exception from it ends the work.
    std::function<void()> check_interruption = {};
};

/// The options' context, or a new one that is current on the calling thread.
/// @throws scene::EnvironmentError  as `raster_gl::Context`.
[[nodiscard]] std::shared_ptr<const raster_gl::Context> opened(const SessionOptions& options);

/// A scene loaded by both renderers.
class LoadedScene {
public:
    /// Context and triangles must outlive this object.
    /// @throws scene::EnvironmentError  if GL or Embree fails.
    LoadedScene(const raster_gl::Context& context, const scene::TriangleScene& triangles,
                const SessionOptions& options);

    [[nodiscard]] const reference_rt::ReferenceScene& reference() const { return scene_; }
    /// Valid as long as this object.
    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }
    [[nodiscard]] double bvh_seconds() const { return bvh_s_; }

private:
    /// Calls `check_interruption` before GL draws or looks up.
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
