#include "analysis/map_errors.hpp"

#include "analysis/bias_units.hpp"
#include "analysis/texel_hits.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::analysis {

namespace {

/// The texel that holds the point.
scene::Texel texel_at(const scene::Vec2f& point)
{
    return {static_cast<int>(point.x), static_cast<int>(point.y)};
}

} // namespace

double zeta_of_depth_m(const scene::LightFrustum& frustum, double depth)
{
    const double from_near = frustum.reversed ? 1 - depth : depth;
    if (frustum.projection == scene::Projection::orthographic) {
        return frustum.near_m + from_near * frustum.range_m();
    }
    return 1 / (1 / frustum.near_m - (1 / frustum.near_m - 1 / frustum.far_m) * from_near);
}

scene::Image<float> map_depth_errors_m(const CauseInputs& inputs,
                                       const scene::LightFrustum& frustum,
                                       scene::DepthFormat format)
{
    const auto& classes = inputs.truth.pixel_class;
    const Footprint footprint{inputs.lookup, inputs.resolution_texels};
    const float farthest = inputs.rules().farthest_depth();
    std::vector<std::size_t> pixels;
    std::vector<scene::Texel> texels;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i]) && footprint.is_inside(inputs.unbiased.texels[i])) {
            pixels.push_back(i);
            texels.push_back(texel_at(inputs.unbiased.texels[i]));
        }
    }
    const TexelHits hits{inputs.light, texels, scene::HitDetail::placed};
    scene::Image<float> errors_m{classes.size(), std::numeric_limits<float>::quiet_NaN()};
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        const scene::TexelHit& hit = hits[texels[p]];
        const float stored = inputs.stored_depth(pixels[p], texels[p]);
        // The farthest depth stands for nothing, unless what is seen rounds to it.
        const bool has_depth = stored != farthest || std::abs(hit.depth - double{farthest}) <=
                                                         depth_step(format, farthest);
        if (hit.triangle != scene::no_triangle && has_depth && !std::isnan(stored)) {
            errors_m[pixels[p]] =
                static_cast<float>(zeta_of_depth_m(frustum, double{stored}) - hit.zeta_m);
        }
    }
    return errors_m;
}

} // namespace gnomon::analysis
