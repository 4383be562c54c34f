#include "cli/session/renderers.hpp"

#include "methods/job_method.hpp"
#include "raster_gl/clip_positions.hpp"
#include "raster_gl/polygon_offset.hpp"
#include "raster_gl/readback.hpp"
#include "reference_rt/light/exact_light.hpp"

#include <stdexcept>

namespace gnomon::cli {

namespace {

/// Of each map a texture with a layer for each sample.
std::vector<raster_gl::Texture> upload_samples(std::span<const scene::Image<float>> samples,
                                               std::size_t maps)
{
    std::vector<raster_gl::Texture> textures;
    for (std::size_t map = 0; map < maps; ++map) {
        std::vector<scene::Image<float>> layers;
        for (const scene::Image<float>& sample : samples) {
            layers.push_back(scene::image_of_map(sample, map));
        }
        textures.push_back(raster_gl::upload_layers(layers));
    }
    return textures;
}

/// Of exact depths those that stand for GL's.
raster_gl::ReceiverDepths receiver_depths_of(const analysis::ExactDepths& depths)
{
    return {&depths.receivers, depths.next_receivers.empty() ? nullptr : &depths.next_receivers};
}

} // namespace

GlRenderer::GlRenderer(const raster_gl::Context& context, const scene::TriangleScene& triangles)
    : context_{context},
      box_{triangles.bounds()},
      scene_{context, triangles},
      shadow_map_pass_{context, raster_gl::ConvertedCodes::dropped},
      sampled_casters_{context},
      peeled_casters_{context},
      prefilter_pass_{context},
      lookup_pass_{context},
      volume_pass_{context, triangles}
{
    select_receivers(0);
}

void GlRenderer::select_receivers(std::size_t slot)
{
    while (receivers_.size() <= slot) {
        receivers_.push_back({std::make_unique<raster_gl::ReceiverPass>(context_), nullptr});
    }
    slot_ = slot;
}

scene::ReceiverLayers GlRenderer::draw_receivers(const scene::View& view)
{
    Receivers& receivers = receivers_[slot_];
    receivers.buffer = &receivers.pass->render(scene_, view, box_);
    return {raster_gl::read_triangles(context_, *receivers.buffer)};
}

std::vector<scene::Vec4f> GlRenderer::receiver_clip_positions(const scene::View& view) const
{
    return raster_gl::capture_clip_positions(
        context_, scene_,
        scene::Mat4f{scene::camera_clip_from_world(view.camera, view.image, box_)});
}

void GlRenderer::draw_shadow_map(const scene::Job& job, const scene::View& view)
{
    using raster_gl::Primitives;
    if (!methods::promises(job).has_map) {
        shadow_map_ = nullptr; // an earlier one is not this job's
        filtered_ = nullptr;
        return;
    }
    shadow_map_ = &shadow_map_pass_.render(
        scene_, view.maps, job.shadow_map,
        methods::passes(job).draws_primitives ? Primitives::kept : Primitives::dropped,
        methods::map_offset(job, view));
    filtered_ = nullptr;
}

void GlRenderer::prefilter_map(const scene::Job& job, const scene::View& view,
                               analysis::FilteredContent content)
{
    if (!methods::promises(job).has_map) {
        return;
    }
    if (methods::passes(job).layers > 1) {
        prefilter(job, content, {peeled_casters_.render(scene_, view.maps, job.shadow_map), true});
        peeled_casters_.forget();
        return;
    }
    const int samples = methods::passes(job).samples;
    if (samples == 1) {
        prefilter(job, content, {});
        return;
    }
    prefilter(job, content,
              {sampled_casters_.render(scene_, view.maps, job.shadow_map, samples,
                                       methods::map_offset(job, view))});
    sampled_casters_.forget();
}

std::vector<scene::Vec2d> GlRenderer::sample_places(int samples)
{
    return sampled_casters_.places(samples);
}

void GlRenderer::prefilter(const scene::Job& job, analysis::FilteredContent content,
                           const raster_gl::SampledDepths& samples)
{
    using raster_gl::FilteredFormats;
    filtered_ = &prefilter_pass_.render(*shadow_map_, methods::passes(job),
                                        content == analysis::FilteredContent::float32
                                            ? FilteredFormats::float32
                                            : FilteredFormats::of_method,
                                        samples);
}

scene::LookupLayers GlRenderer::look_up(const scene::Job& job, const scene::View& view)
{
    if (const auto volumes = methods::passes(job).volumes) {
        return volume_pass_.look_up({scene_, drawn_receivers()}, view, *volumes);
    }
    lookup_pass_.render(looked_up(), job, view);
    return lookup_pass_.read();
}

scene::LookupTerms GlRenderer::read_terms(const scene::Job& job, const scene::View& view)
{
    return lookup_pass_.read_terms(looked_up(), job, view);
}

analysis::DrawnFloats GlRenderer::draw_floats(const scene::Job& job, const scene::View& view,
                                              const std::optional<methods::PolygonOffset>& offset)
{
    scene::ShadowMapSettings floats = job.shadow_map;
    floats.depth_format = scene::float_depth_format;
    shadow_map_ =
        &shadow_map_pass_.render(scene_, view.maps, floats, raster_gl::Primitives::kept, offset);
    filtered_ = nullptr;
    return {raster_gl::read_shader_depths(context_, *shadow_map_),
            raster_gl::read_primitives(context_, *shadow_map_)};
}

scene::Image<float> GlRenderer::find_critical_biases(const scene::Job& job, const scene::View& view)
{
    return lookup_pass_.find_critical_biases(looked_up(), job, view);
}

void GlRenderer::take_exact(const scene::Job& job, const scene::View& view,
                            const analysis::ExactDepths& depths)
{
    shadow_map_ = &shadow_map_pass_.store(depths.map, view.first_map().reversed);
    const std::vector<raster_gl::Texture> samples =
        depths.samples.empty() ? std::vector<raster_gl::Texture>{}
                               : upload_samples(depths.samples, view.maps.size());
    prefilter(job, analysis::FilteredContent::float32, {samples, true});
}

std::vector<scene::Image<float>>
GlRenderer::find_exact_critical_biases(const scene::Job& job, const scene::View& view,
                                       const analysis::ExactDepths& depths,
                                       std::span<const float> lit_from)
{
    take_exact(job, view, depths);
    scene::View placed = view;
    placed.bias.constant = 0;
    placed.bias.slope = 0;
    std::vector<scene::Image<float>> criticals;
    for (const float least : lit_from) {
        criticals.push_back(lookup_pass_.find_critical_biases(looked_up(), job, placed,
                                                              {least, receiver_depths_of(depths)}));
    }
    return criticals;
}

std::vector<scene::Image<float>> GlRenderer::look_up_exactly(const scene::Job& job,
                                                             const scene::View& view,
                                                             const analysis::ExactDepths& depths,
                                                             std::span<const scene::Bias> biases)
{
    take_exact(job, view, depths);
    std::vector<scene::Image<float>> verdicts;
    for (const scene::Bias& bias : biases) {
        scene::View biased = view;
        biased.bias = bias;
        lookup_pass_.render(looked_up(), job, biased, receiver_depths_of(depths));
        const auto samples = lookup_pass_.read().samples;
        scene::Image<float>& of_bias = verdicts.emplace_back(samples.size());
        for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
            of_bias[i] = samples[i].verdict;
        }
    }
    return verdicts;
}

raster_gl::LookedUp GlRenderer::looked_up() const
{
    if (shadow_map_ == nullptr) {
        throw std::invalid_argument("GlRenderer: draw the shadow map first");
    }
    return {scene_, drawn_receivers(), *shadow_map_, filtered_};
}

const raster_gl::ReceiverBuffer& GlRenderer::drawn_receivers() const
{
    const raster_gl::ReceiverBuffer* receivers = receivers_[slot_].buffer;
    if (receivers == nullptr) {
        throw std::invalid_argument("GlRenderer: draw the receivers first");
    }
    return *receivers;
}

scene::Image<float> GlRenderer::read_map_depths() const
{
    if (shadow_map_ == nullptr) {
        throw std::invalid_argument("GlRenderer::read_map_depths: draw the shadow map first");
    }
    return raster_gl::read_shader_depths(context_, *shadow_map_);
}

std::vector<scene::OffsetUnit> GlRenderer::measure_offset_units(scene::DepthFormat format) const
{
    return raster_gl::measure_offset_units(context_, format);
}

void GlRenderer::forget_shadow_map()
{
    shadow_map_ = nullptr;
    filtered_ = nullptr;
    prefilter_pass_.forget();
    shadow_map_pass_.forget();
}

scene::Image<float> GlRenderer::read_float_depths(const scene::Job& job, const scene::View& view,
                                                  scene::TexelRows rows)
{
    scene::ShadowMapSettings floats = job.shadow_map;
    floats.depth_format = scene::float_depth_format;
    shadow_map_ = &shadow_map_pass_.render(scene_, view.maps, floats, rows);
    filtered_ = nullptr;
    return raster_gl::read_shader_depths(context_, *shadow_map_, rows);
}

namespace {

/// The renderers that judge: the truth, and light as the reference has it.
void add_truth(analysis::Renderers& renderers, GlRenderer& gl, int subpixel_bits,
               const reference_rt::ReferenceScene& reference,
               const reference_rt::TruthOptions& options)
{
    renderers.find_truth = [&gl, &reference, subpixel_bits, options](
                               const scene::View& view, const scene::ReceiverLayers& receivers) {
        const reference_rt::RasterFacts raster{subpixel_bits, gl.receiver_clip_positions(view)};
        return reference_rt::compute_truth(reference, view, receivers.triangle, raster, options);
    };
    if (options.method == reference_rt::TruthMethod::exact) {
        renderers.make_exact_light =
            [&reference, threads = options.threads](const scene::Job& job, const scene::View& view,
                                                    const scene::ReceiverLayers& receivers) {
                return reference_rt::make_exact_light(reference, view, receivers.triangle,
                                                      job.shadow_map.resolution_texels,
                                                      job.shadow_map.cull, threads);
            };
    }
    const bool is_float = options.method == reference_rt::TruthMethod::plain;
    renderers.truth_method = is_float ? "float" : "exact";
}

} // namespace

analysis::Renderers make_renderers(GlRenderer& gl, const raster_gl::GlFacts& facts,
                                   const reference_rt::ReferenceScene& reference,
                                   const reference_rt::TruthOptions& options)
{
    analysis::Renderers renderers;
    renderers.draw_receivers = [&gl](const scene::View& view) { return gl.draw_receivers(view); };
    renderers.select_receivers = [&gl](std::size_t slot) { gl.select_receivers(slot); };
    renderers.draw_shadow_map = [&gl](const scene::Job& job, const scene::View& view) {
        gl.draw_shadow_map(job, view);
    };
    renderers.prefilter_map = [&gl](const scene::Job& job, const scene::View& view,
                                    analysis::FilteredContent content) {
        gl.prefilter_map(job, view, content);
    };
    renderers.sample_places = [&gl](int samples) { return gl.sample_places(samples); };
    renderers.look_up = [&gl](const scene::Job& job, const scene::View& view) {
        return gl.look_up(job, view);
    };
    renderers.read_terms = [&gl](const scene::Job& job, const scene::View& view) {
        return gl.read_terms(job, view);
    };
    renderers.draw_floats = [&gl](const scene::Job& job, const scene::View& view,
                                  const std::optional<methods::PolygonOffset>& offset) {
        return gl.draw_floats(job, view, offset);
    };
    renderers.find_critical_biases = [&gl](const scene::Job& job, const scene::View& view) {
        return gl.find_critical_biases(job, view);
    };
    renderers.find_exact_critical_biases = [&gl](const scene::Job& job, const scene::View& view,
                                                 const analysis::ExactDepths& depths,
                                                 std::span<const float> lit_from) {
        return gl.find_exact_critical_biases(job, view, depths, lit_from);
    };
    renderers.look_up_exactly = [&gl](const scene::Job& job, const scene::View& view,
                                      const analysis::ExactDepths& depths,
                                      std::span<const scene::Bias> biases) {
        return gl.look_up_exactly(job, view, depths, biases);
    };
    renderers.read_map_depths = [&gl] { return gl.read_map_depths(); };
    renderers.forget_shadow_map = [&gl] { gl.forget_shadow_map(); };
    renderers.read_float_depths = [&gl](const scene::Job& job, const scene::View& view,
                                        scene::TexelRows rows) {
        return gl.read_float_depths(job, view, rows);
    };
    renderers.measure_offset_units = [&gl](scene::DepthFormat format) {
        return gl.measure_offset_units(format);
    };
    add_truth(renderers, gl, facts.subpixel_bits, reference, options);
    renderers.subpixel_bits = facts.subpixel_bits;
    renderers.environment = {facts.renderer, facts.version, reference_rt::embree_version(),
                             GNOMON_VERSION};
    return renderers;
}

} // namespace gnomon::cli
