#include "analysis/bias/kept_terms.hpp"

#include "methods/job_method.hpp"

#include <cmath>

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

std::optional<KeptTerms> find_kept_terms(const scene::Job& job, const scene::View& view,
                                         const scene::TriangleScene& triangles,
                                         const Renderers& renderers)
{
    if (!methods::moves_lookups(job, view) || !renderers.read_terms) {
        return std::nullopt;
    }
    return KeptTerms{
        renderers.read_terms(job, view), find_map_offsets(job, view, triangles, renderers),
        methods::passes(job).sampling == methods::Sampling::compared, view.first_map().reversed};
}

} // namespace gnomon::analysis
