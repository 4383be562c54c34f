#include "raster_gl/rasterizer.hpp"

#include "methods/job_method.hpp"
#include "raster_gl/map/raster_planes.hpp"
#include "raster_gl/readback.hpp"
#include "raster_gl/receivers.hpp"

#include <exception>
#include <span>
#include <stdexcept>
#include <utility>

namespace gnomon::raster_gl {

namespace {

/// Uploads an array texture for each map, with a layer for each sample.
std::vector<Texture> upload_samples(std::span<const scene::Image<float>> samples, std::size_t maps)
{
    std::vector<Texture> textures;
    for (std::size_t map = 0; map < maps && !samples.empty(); ++map) {
        std::vector<scene::Image<float>> layers;
        for (const scene::Image<float>& sample : samples) {
            layers.push_back(scene::image_of_map(sample, map));
        }
        textures.push_back(upload_layers(layers));
    }
    return textures;
}

/// The request's polygon offset, or the job's by default.
std::optional<methods::PolygonOffset> offset_of(const renderers::MapRequest& request,
                                                const scene::Job& job, const scene::View& view)
{
    if (!request.offset) {
        return methods::map_offset(job, view);
    }
    const bool is_none = request.offset->factor == 0 && request.offset->units == 0;
    return is_none ? std::nullopt : request.offset;
}

/// Casts a value to this rasterizer's own type.
template <typename Own, typename Value>
std::shared_ptr<const Own> require_own(const std::shared_ptr<const Value>& value)
{
    auto own = std::dynamic_pointer_cast<const Own>(value);
    if (own == nullptr) {
        throw std::invalid_argument("GlRasterizer: another rasterizer drew it");
    }
    return own;
}

} // namespace

class GlRasterizer::DrawnReceivers final : public renderers::Receivers {
public:
    DrawnReceivers(GlRasterizer& rasterizer, ReceiverBuffer buffer, const scene::View& view)
        : rasterizer_{rasterizer},
          buffer_{std::move(buffer)},
          clip_from_world_{scene::camera_clip_from_world(view.camera, view.image, rasterizer.box_)}
    {
    }
    DrawnReceivers(const DrawnReceivers&) = delete;
    DrawnReceivers& operator=(const DrawnReceivers&) = delete;
    ~DrawnReceivers() override { rasterizer_.receiver_pass_.give_back(std::move(buffer_)); }

    [[nodiscard]] scene::ReceiverLayers layers() const override
    {
        return {read_triangles(rasterizer_.context_, buffer_)};
    }
    [[nodiscard]] renderers::RasterFacts raster_facts() const override
    {
        return {rasterizer_.subpixel_bits(),
                capture_clip_positions(rasterizer_.context_, rasterizer_.scene_, clip_from_world_)};
    }
    [[nodiscard]] const ReceiverBuffer& buffer() const { return buffer_; }

private:
    GlRasterizer& rasterizer_;
    ReceiverBuffer buffer_;
    scene::Mat4f clip_from_world_;
};

class GlRasterizer::DrawnMap final : public renderers::ShadowMap {
public:
    DrawnMap(GlRasterizer& rasterizer, raster_gl::ShadowMap map,
             std::optional<scene::TexelRows> rows = {})
        : rasterizer_{rasterizer},
          map_{std::move(map)},
          rows_{rows.value_or(scene::TexelRows{0, map_.resolution_texels})}
    {
    }
    DrawnMap(const DrawnMap&) = delete;
    DrawnMap& operator=(const DrawnMap&) = delete;
    ~DrawnMap() override
    {
        if (map_.depth.empty()) {
            return;
        }
        try {
            rasterizer_.shadow_map_pass_.give_back(std::move(map_));
        } catch (const std::exception&) {
            // The driver keeps a large map's memory longer; no result is lost.
        }
    }

    [[nodiscard]] scene::Image<float> depths() const override
    {
        return read_shader_depths(rasterizer_.context_, drawn(), rows_);
    }
    [[nodiscard]] scene::Image<std::uint32_t> triangles() const override
    {
        return read_primitives(rasterizer_.context_, drawn());
    }
    /// @throws std::invalid_argument  if the job's method has no map.
    [[nodiscard]] const raster_gl::ShadowMap& drawn() const
    {
        if (map_.depth.empty()) {
            throw std::invalid_argument("GlRasterizer: the job's method draws no map");
        }
        return map_;
    }

private:
    GlRasterizer& rasterizer_;
    raster_gl::ShadowMap map_;
    scene::TexelRows rows_;
};

class GlRasterizer::PrefilteredMap final : public renderers::FilteredMap {
public:
    PrefilteredMap(GlRasterizer& rasterizer, std::shared_ptr<const DrawnMap> map,
                   FilteredTexture filtered = {})
        : FilteredMap{map},
          rasterizer_{rasterizer},
          drawn_{*map},
          filtered_{std::move(filtered)}
    {
    }
    PrefilteredMap(const PrefilteredMap&) = delete;
    PrefilteredMap& operator=(const PrefilteredMap&) = delete;
    ~PrefilteredMap() override { rasterizer_.prefilter_pass_.give_back(std::move(filtered_)); }

    [[nodiscard]] const raster_gl::ShadowMap& drawn() const { return drawn_.drawn(); }
    [[nodiscard]] const LayeredTexture* filtered() const { return &filtered_.texture; }

private:
    GlRasterizer& rasterizer_;
    const DrawnMap& drawn_; ///< owned by the base
    FilteredTexture filtered_;
};

GlRasterizer::GlRasterizer(const Context& context, const scene::TriangleScene& triangles)
    : context_{context},
      box_{triangles.bounds()},
      scene_{context, triangles},
      receiver_pass_{context},
      shadow_map_pass_{context, ConvertedCodes::dropped},
      multisampled_depth_{context},
      depth_peeling_{context},
      prefilter_pass_{context},
      lookup_pass_{context},
      volume_pass_{context, triangles}
{
}

std::shared_ptr<const renderers::Receivers> GlRasterizer::draw_receivers(const scene::View& view)
{
    receiver_pass_.render(scene_, view, box_);
    return std::make_shared<DrawnReceivers>(*this, receiver_pass_.take(), view);
}

std::shared_ptr<const renderers::ShadowMap>
GlRasterizer::draw_map(const scene::Job& job, const scene::View& view,
                       const renderers::MapRequest& request)
{
    if (!methods::traits(job).has_map) {
        return std::make_shared<DrawnMap>(*this, raster_gl::ShadowMap{});
    }
    const bool keeps_triangles = request.keeps_triangles || methods::passes(job).draws_primitives;
    shadow_map_pass_.render(scene_, view.maps, job.shadow_map,
                            keeps_triangles ? Primitives::kept : Primitives::dropped,
                            offset_of(request, job, view), request.rows);
    return std::make_shared<DrawnMap>(*this, shadow_map_pass_.take(), request.rows);
}

std::shared_ptr<const renderers::FilteredMap>
GlRasterizer::filter_map(std::shared_ptr<const renderers::ShadowMap> map, const scene::Job& job,
                         const scene::View& view, renderers::FilteredContent content)
{
    auto drawn = require_own<DrawnMap>(map);
    map.reset();
    if (!methods::traits(job).has_map) {
        return std::make_shared<PrefilteredMap>(*this, std::move(drawn));
    }
    const methods::Passes passes = methods::passes(job);
    if (passes.layers > 1) {
        auto made = prefiltered(std::move(drawn), job, content,
                                {depth_peeling_.render(scene_, view.maps, job.shadow_map), true});
        depth_peeling_.forget();
        return made;
    }
    if (passes.samples == 1) {
        return prefiltered(std::move(drawn), job, content, {});
    }
    auto made =
        prefiltered(std::move(drawn), job, content,
                    {multisampled_depth_.render(scene_, view.maps, job.shadow_map, passes.samples,
                                                methods::map_offset(job, view))});
    multisampled_depth_.forget();
    return made;
}

std::shared_ptr<const renderers::FilteredMap>
GlRasterizer::prefiltered(std::shared_ptr<const DrawnMap> map, const scene::Job& job,
                          renderers::FilteredContent content, const SampledDepths& samples)
{
    prefilter_pass_.render(map->drawn(), methods::passes(job), content, samples);
    return std::make_shared<PrefilteredMap>(*this, std::move(map), prefilter_pass_.take());
}

std::shared_ptr<const renderers::FilteredMap>
GlRasterizer::store_map(const scene::Job& job, const scene::View& view,
                        const renderers::ExactDepths& depths)
{
    shadow_map_pass_.store(depths.map, view.first_map().reversed);
    auto map = std::make_shared<DrawnMap>(*this, shadow_map_pass_.take());
    const std::vector<Texture> samples = upload_samples(depths.samples, view.maps.size());
    return prefiltered(std::move(map), job, renderers::FilteredContent::float32, {samples, true});
}

LookupSource GlRasterizer::looked_up(const renderers::Drawn& drawn) const
{
    const auto receivers = require_own<DrawnReceivers>(drawn.receivers);
    const auto map = require_own<PrefilteredMap>(drawn.map);
    return {scene_, receivers->buffer(), map->drawn(), map->filtered()};
}

scene::LookupLayers GlRasterizer::look_up(const renderers::LookupRequest& request)
{
    if (const auto volumes = methods::passes(request.job).volumes) {
        const auto receivers = require_own<DrawnReceivers>(request.drawn.receivers);
        return volume_pass_.look_up({scene_, receivers->buffer()}, request.view, *volumes);
    }
    lookup_pass_.render(looked_up(request.drawn), request.job, request.view, request.depths);
    return lookup_pass_.read();
}

std::optional<scene::LookupTerms> GlRasterizer::read_terms(const renderers::LookupRequest& request)
{
    return lookup_pass_.read_terms(looked_up(request.drawn), request.job, request.view);
}

scene::Image<float> GlRasterizer::find_critical_biases(const renderers::LookupRequest& request,
                                                       float lit_from)
{
    return lookup_pass_.find_critical_biases(looked_up(request.drawn), request.job, request.view,
                                             {lit_from, request.depths});
}

std::vector<scene::Vec2d> GlRasterizer::sample_places(int samples)
{
    return multisampled_depth_.places(samples);
}

std::vector<scene::OffsetUnit> GlRasterizer::measure_offset_units(scene::DepthFormat format)
{
    return raster_gl::measure_offset_units(context_, format);
}

void GlRasterizer::release_spares()
{
    receiver_pass_.forget();
    prefilter_pass_.forget();
    shadow_map_pass_.forget();
}

} // namespace gnomon::raster_gl
