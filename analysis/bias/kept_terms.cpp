#include "analysis/bias/kept_terms.hpp"

#include "methods/job_method.hpp"

#include <cmath>
#include <utility>

namespace gnomon::analysis {

float KeptTerms::rise(std::size_t pixel, const scene::Vec2f& centre,
                      const scene::Vec2f& point) const
{
    if (lookup.gradients.empty()) {
        return 0;
    }
    // As raster_gl/shaders/lookup_map.glsl: each product and sum rounded.
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
