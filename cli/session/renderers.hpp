#pragma once

#include "analysis/comparison.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/lookup.hpp"
#include "raster_gl/peeled_casters.hpp"
#include "raster_gl/prefilter.hpp"
#include "raster_gl/receivers.hpp"
#include "raster_gl/sampled_casters.hpp"
#include "raster_gl/shadow_map.hpp"
#include "raster_gl/shadow_volumes.hpp"
#include "reference_rt/truth.hpp"
#include "scene/depth/offset_unit.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::cli {

/// GL's passes over one scene, with the textures that they keep from call to call.
class GlRenderer {
public:
    /// Both arguments must outlive the renderer.
    GlRenderer(const raster_gl::Context& context, const scene::TriangleScene& triangles);

    /// Which of several receivers, kept side by side, the other calls mean; 0 at first.
    void select_receivers(std::size_t slot);
    [[nodiscard]] scene::ReceiverLayers draw_receivers(const scene::View& view);
    /// The clip positions that GL gave the vertices when it drew the receivers.
    [[nodiscard]] std::vector<scene::Vec4f> receiver_clip_positions(const scene::View& view) const;
    /// Draws the job's map; nothing where its method has none.
    void draw_shadow_map(const scene::Job& job, const scene::View& view);
    /// Makes of the last shadow map what the job's method looks up.
    void prefilter_map(const scene::Job& job, const scene::View& view,
                       analysis::FilteredContent content);
    /// Where in a texel the driver's samples are.
    [[nodiscard]] std::vector<scene::Vec2d> sample_places(int samples);
    /// Looks the selected receivers up in the last shadow map, or decides them without one.
    [[nodiscard]] scene::LookupLayers look_up(const scene::Job& job, const scene::View& view);
    /// What the view's biases beside constant and slope do to those lookups.
    [[nodiscard]] scene::LookupTerms read_terms(const scene::Job& job, const scene::View& view);
    /// The smallest constant bias with which each of them is lit, found by trying.
    [[nodiscard]] scene::Image<float> find_critical_biases(const scene::Job& job,
                                                           const scene::View& view);
    /// The same in a map of exact depths, which takes the last one's place, and of exact receivers:
    /// an image for each of `lit_from`.
    [[nodiscard]] std::vector<scene::Image<float>>
    find_exact_critical_biases(const scene::Job& job, const scene::View& view,
                               const analysis::ExactDepths& depths,
                               std::span<const float> lit_from);
    /// The verdicts there with each of `biases`.
    [[nodiscard]] std::vector<scene::Image<float>>
    look_up_exactly(const scene::Job& job, const scene::View& view,
                    const analysis::ExactDepths& depths, std::span<const scene::Bias> biases);
    /// Draws the job's map as d32f, which takes its place, with this offset, and reads it.
    [[nodiscard]] analysis::DrawnFloats
    draw_floats(const scene::Job& job, const scene::View& view,
                const std::optional<methods::PolygonOffset>& offset);
    /// The last shadow map's depths, as shaders see them.
    [[nodiscard]] scene::Image<float> read_map_depths() const;
    /// The driver's unit of polygon offset in maps of the format, at depths across [0, 1].
    [[nodiscard]] std::vector<scene::OffsetUnit>
    measure_offset_units(scene::DepthFormat format) const;
    /// Gives the last shadow map's memory back: it is to be drawn again before it is asked.
    void forget_shadow_map();
    /// Draws these rows of the job's map as d32f, which takes its place, and reads their depths.
    [[nodiscard]] scene::Image<float>
    read_float_depths(const scene::Job& job, const scene::View& view, scene::TexelRows rows);

private:
    /// The selected ones.
    /// @throws std::invalid_argument  if they were not drawn.
    [[nodiscard]] const raster_gl::ReceiverBuffer& drawn_receivers() const;
    /// Takes exact depths for the last shadow map, and makes of them what the method looks up.
    void take_exact(const scene::Job& job, const scene::View& view,
                    const analysis::ExactDepths& depths);
    /// Makes of the last shadow map, or of depths at samples, what the job's method looks up.
    void prefilter(const scene::Job& job, analysis::FilteredContent content,
                   const raster_gl::SampledDepths& samples);
    /// The selected ones, and what they are looked up in.
    [[nodiscard]] raster_gl::LookedUp looked_up() const;

    struct Receivers {
        std::unique_ptr<raster_gl::ReceiverPass> pass;
        const raster_gl::ReceiverBuffer* buffer = nullptr; ///< nullptr until drawn
    };

    const raster_gl::Context& context_;
    scene::Box box_;
    raster_gl::GpuScene scene_;
    std::vector<Receivers> receivers_; ///< by slot
    std::size_t slot_ = 0;
    raster_gl::ShadowMapPass shadow_map_pass_;
    raster_gl::SampledCasters sampled_casters_;
    raster_gl::PeeledCasters peeled_casters_;
    raster_gl::PrefilterPass prefilter_pass_;
    raster_gl::LookupPass lookup_pass_;
    raster_gl::ShadowVolumePass volume_pass_;
    const raster_gl::ShadowMap* shadow_map_ = nullptr;
    const raster_gl::LayeredTexture* filtered_ = nullptr; ///< made of it; nullptr until then
};

/// Both renderers as the callables that `analysis::compare` takes; the arguments must outlive it.
[[nodiscard]] analysis::Renderers make_renderers(GlRenderer& gl, const raster_gl::GlFacts& facts,
                                                 const reference_rt::ReferenceScene& reference,
                                                 const reference_rt::TruthOptions& options);

} // namespace gnomon::cli
