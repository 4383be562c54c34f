#include "analysis/bias/kept_terms.hpp"

#include "analysis/bias/drawn_offset.hpp"
#include "methods/job_method.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::analysis {

namespace {

/// A job's map as float32.
struct DrawnFloats {
    scene::Image<float> depths;
    scene::Image<std::uint32_t> triangles; ///< triangle of each texel, or `no_triangle`
};

DrawnFloats draw_floats(scene::Job job, const scene::View& view,
                        const methods::PolygonOffset& offset, renderers::Rasterizer& rasterizer)
{
    job.shadow_map.depth_format = scene::float_depth_format;
    const auto map =
        rasterizer.draw_map(job, view, {.keeps_triangles = true, .offset = offset, .rows = {}});
    return {map->depths(), map->triangles()};
}

} // namespace

MapOffsets::MapOffsets(const methods::PolygonOffset& offset, const scene::Job& job,
                       const scene::View& view, const scene::TriangleScene& triangles,
                       renderers::Rasterizer& rasterizer)
    : offset_{offset},
      format_{job.shadow_map.depth_format},
      maps_{view.maps},
      resolution_texels_{job.shadow_map.resolution_texels},
      triangles_{&triangles},
      units_{rasterizer.measure_offset_units(job.shadow_map.depth_format)}
{
    if (offset.factor == 0) {
        return;
    }
    DrawnFloats plain = draw_floats(job, view, {}, rasterizer);
    DrawnFloats moved = draw_floats(job, view, {offset.factor, 0, 0}, rasterizer);
    shows_same_triangle_ = scene::Image<std::uint8_t>{plain.triangles.size()};
    for (std::size_t i = 0; i < shows_same_triangle_.pixel_count(); ++i) {
        moved.depths[i] -= plain.depths[i];
        shows_same_triangle_[i] = moved.triangles[i] == plain.triangles[i] ? 1 : 0;
    }
    measured_offsets_ = std::move(moved.depths);
    shown_triangles_ = std::move(plain.triangles);
}

double MapOffsets::of_factor(const scene::Texel& texel, std::uint32_t triangle) const
{
    if (offset_.factor == 0 || triangle == scene::no_triangle) {
        return 0;
    }
    if (at_texel(shown_triangles_, texel) == triangle &&
        at_texel(shows_same_triangle_, texel) != 0) {
        return double{at_texel(measured_offsets_, texel)};
    }
    return of_plane(texel.map, triangle);
}

double MapOffsets::of_plane(int map, std::uint32_t triangle) const
{
    if (offset_.factor == 0) {
        return 0; // however steep the plane is
    }
    const double slope = largest_slope(maps_[static_cast<std::size_t>(map)],
                                       triangles_->corners(triangle), resolution_texels_);
    return std::isnan(slope) ? 0 : double{offset_.factor} * slope;
}

double MapOffsets::limited(double of_factor, double depth) const
{
    const double r = offset_unit_at(units_, format_, depth);
    return std::clamp(depth + limited_sum(offset_, of_factor, r), 0.0, 1.0) - depth;
}

double MapOffsets::at(const scene::Texel& texel, std::uint32_t triangle, double depth) const
{
    return limited(of_factor(texel, triangle), depth);
}

double MapOffsets::at_receiver(int map, std::uint32_t triangle, double depth) const
{
    return limited(of_plane(map, triangle), depth);
}

double MapOffsets::at(const scene::Texel& texel, double depth) const
{
    const double farthest = maps_.front().reversed ? 0 : 1;
    return depth == farthest ? 0
                             : at(texel,
                                  shown_triangles_.empty() ? scene::no_triangle
                                                           : at_texel(shown_triangles_, texel),
                                  depth);
}

std::optional<MapOffsets> find_map_offsets(const scene::Job& job, const scene::View& view,
                                           const scene::TriangleScene& triangles,
                                           renderers::Rasterizer& rasterizer)
{
    const auto offset = methods::map_offset(job, view);
    if (!offset) {
        return std::nullopt;
    }
    return MapOffsets{*offset, job, view, triangles, rasterizer};
}

float KeptTerms::rise(std::size_t pixel, const scene::Vec2f& centre,
                      const scene::Vec2f& point) const
{
    if (lookup.gradients.empty()) {
        return 0;
    }
    // As in raster_gl/shaders/lookup_map.glsl: each product and sum is rounded.
    const scene::Vec2f gradient = lookup.gradients[pixel];
    if (compares_at_once) {
        const float rise = 2.0F * (std::abs(gradient.x) + std::abs(gradient.y));
        return is_reversed ? rise : -rise;
    }
    const scene::Vec2f way = centre - point;
    return gradient.x * way.x + gradient.y * way.y;
}

std::optional<KeptTerms> make_kept_terms(const scene::Job& job, const scene::View& view,
                                         scene::LookupTerms terms,
                                         std::optional<MapOffsets> offsets)
{
    if (!methods::moves_lookups(job, view)) {
        return std::nullopt;
    }
    return KeptTerms{std::move(terms), std::move(offsets),
                     methods::passes(job).sampling == methods::Sampling::compared,
                     view.first_map().reversed};
}

std::optional<KeptTerms> find_kept_terms(const scene::Job& job, const scene::View& view,
                                         const scene::TriangleScene& triangles,
                                         const renderers::Drawn& drawn,
                                         renderers::Rasterizer& rasterizer)
{
    if (!methods::moves_lookups(job, view)) {
        return std::nullopt;
    }
    auto terms = rasterizer.read_terms({drawn, job, view});
    if (!terms) {
        return std::nullopt;
    }
    return make_kept_terms(job, view, std::move(*terms),
                           find_map_offsets(job, view, triangles, rasterizer));
}

} // namespace gnomon::analysis
