#include "analysis/metrics/map_depth_errors.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/lookup/footprint.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::analysis {

namespace {

/// The texel that contains the point.
scene::Texel texel_at(const scene::MapPoint& point)
{
    return {static_cast<int>(point.texel.x), static_cast<int>(point.texel.y), point.map};
}

} // namespace

CentreHits::CentreHits(const CauseInputs& inputs)
    : CentreHits{inputs, [&](std::span<const scene::Texel> texels) {
                     return inputs.light.first_hits(texels, renderers::HitDetail::placed);
                 }}
{
}

CentreHits::CentreHits(const CauseInputs& inputs, const FindFirstHits& find)
    : CentreHits{find_centres(inputs), find}
{
}

CentreHits::CentreHits(const Centres& centres, const FindFirstHits& find)
    : seen_(centres.pixels.size()),
      hits_{centres.texels, find}
{
    for_each_run(seen_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            const std::size_t hit = hits_.number_of(centres.texels[i]);
            seen_[i] = {centres.pixels[i], static_cast<std::uint32_t>(hit)};
        }
    });
}

CentreHits::Centres CentreHits::find_centres(const CauseInputs& inputs)
{
    const auto& classes = inputs.truth.pixel_class;
    const Footprint footprint = inputs.footprint();
    Centres centres;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i]) && footprint.is_inside(inputs.unbiased.at(i))) {
            centres.pixels.push_back(static_cast<std::uint32_t>(i));
            centres.texels.push_back(texel_at(inputs.unbiased.at(i)));
        }
    }
    return centres;
}

scene::Image<float> map_depth_errors_m(const CauseInputs& inputs, const CentreHits& hits,
                                       std::span<const scene::LightFrustum> maps,
                                       scene::DepthFormat format)
{
    std::vector<DepthMapping> mappings;
    for (const scene::LightFrustum& map : maps) {
        mappings.emplace_back(map.stored_range());
    }
    const bool is_along_ray = traits_of(maps.front().content).measure == scene::Measure::ray;
    const float farthest = inputs.rule.farthest_depth();
    scene::Image<float> errors_m{inputs.truth.pixel_class.size(),
                                 std::numeric_limits<float>::quiet_NaN()};
    const auto& seen = hits.seen();
    for_each_run(seen.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            const renderers::TexelHit& hit = hits.hit(seen[i]);
            const scene::Texel& texel = hits.texel(seen[i]);
            const float stored = inputs.stored_depth(inputs.unbiased, seen[i].pixel, texel);
            const DepthMapping& mapping = mappings[static_cast<std::size_t>(texel.map)];
            // The farthest depth means an empty texel, unless the surface seen rounds to it.
            const bool has_depth = stored != farthest || std::abs(hit.depth - double{farthest}) <=
                                                             depth_step(format, farthest);
            if (hit.triangle != scene::no_triangle && has_depth && !std::isnan(stored)) {
                const double exact_m =
                    is_along_ray ? mapping.light_distance_m(hit.depth) : hit.light_distance_m;
                errors_m[seen[i].pixel] =
                    static_cast<float>(mapping.light_distance_m(double{stored}) - exact_m);
            }
        }
    });
    return errors_m;
}

} // namespace gnomon::analysis
