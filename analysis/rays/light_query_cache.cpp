#include "analysis/rays/light_query_cache.hpp"

#include "analysis/causes/find_causes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::analysis {

LightQueryCache::LightQueryCache(const scene::TriangleScene& triangles,
                                 std::shared_ptr<ScoredReceivers> receivers, const scene::Job& job,
                                 const scene::View& view, const renderers::Reference& reference)
    : receivers_{std::move(receivers)},
      triangles_{triangles},
      view_{view},
      resolution_texels_{job.shadow_map.resolution_texels},
      cull_{job.shadow_map.cull},
      geometry_{triangles, view_, receivers_->receivers().triangle},
      light_{reference.make_light_queries(job, view_, receivers_->receivers())},
      light_distance_m_{receivers_->light_distance_m(view_.first_map(), geometry_)},
      distances_{receivers_->distances(view_.first_map(), geometry_)},
      pixel_gaps_{size_if(receivers_->use().by_many_maps), unknown_gap}
{
}

scene::ImageSize LightQueryCache::size_if(bool is_kept) const
{
    return is_kept ? view_.image : scene::ImageSize{0, 0};
}

std::optional<double> LightQueryCache::representative_light_distance_m()
{
    if (view_.first_map().projection == scene::Projection::orthographic) {
        const auto scored =
            std::ranges::find_if(*light_distance_m_, [](float m) { return std::isfinite(m); });
        return scored != light_distance_m_->end() ? std::optional{double{*scored}} : std::nullopt;
    }
    if (!light_distance_quantiles_m_) {
        light_distance_quantiles_m_ = find_quantiles(
            std::vector<float>(light_distance_m_->begin(), light_distance_m_->end()));
    }
    return light_distance_quantiles_m_ ? std::optional{double{light_distance_quantiles_m_->median}}
                                       : std::nullopt;
}

const CellMap& LightQueryCache::cells()
{
    if (cells_ == nullptr) {
        cells_ = receivers_->cells(view_.first_map(), geometry_, triangles_);
    }
    return *cells_;
}

CauseCache* LightQueryCache::causes_of(const CauseInputs& inputs)
{
    const methods::LookupTraits& traits = inputs.rule.traits;
    // The kept terms may depend on the format, as an offset's unit does.
    const bool remembers = receivers_->use().by_many_maps && traits.has_one_tap() &&
                           traits.compares_depths() && inputs.terms == nullptr;
    if (remembers && !causes_) {
        causes_.emplace(view_.image);
    }
    return remembers ? &*causes_ : nullptr;
}

renderers::ExactDepths LightQueryCache::exact_depths(const CauseInputs& inputs,
                                                     std::span<const scene::Vec2d> places,
                                                     int layers)
{
    if (!exact_depths_) {
        exact_depths_.emplace(scene::maps_image_size(resolution_texels_, view_.maps.size()),
                              view_.image);
    }
    return exact_depths_->of(inputs, places, layers);
}

CauseInputs LightQueryCache::with_known_hits(CauseInputs inputs)
{
    inputs.known_hits = &centre_hits(inputs).hits();
    return inputs;
}

void LightQueryCache::find_lit(const CauseInputs& inputs, PixelCauses& causes)
{
    find_lit_causes(with_known_hits(inputs), causes, causes_of(inputs));
}

void LightQueryCache::find_blocked(const CauseInputs& inputs,
                                   const scene::Image<std::uint8_t>& wanted, PixelCauses& causes)
{
    // Tracing all of the image's hits would cost more than tracing the few that are needed.
    CauseInputs known = inputs;
    known.known_hits = centre_hits_ ? &centre_hits_->hits() : nullptr;
    find_blocked_causes(known, wanted, causes, causes_of(inputs));
}

const CentreHits& LightQueryCache::centre_hits(const CauseInputs& inputs)
{
    if (!centre_hits_) {
        centre_hits_.emplace(inputs, [&](std::span<const scene::Texel> texels) {
            return receivers_->first_hits().first_hits(
                {*light_, view_.maps, resolution_texels_, cull_}, texels);
        });
    }
    return *centre_hits_;
}

std::vector<PixelGap> LightQueryCache::find_gaps(std::span<const std::size_t> pixels,
                                                 const scene::MapIndices& maps)
{
    BlockerGapCache& gaps = receivers_->gaps(cull_);
    gaps.find(*light_, pixels);
    return gaps_of_pixels(gaps, pixels, geometry_, {view_.maps, maps, resolution_texels_});
}

std::vector<PixelGap> LightQueryCache::pixel_gaps(std::span<const std::size_t> pixels,
                                                  const scene::MapIndices& maps)
{
    if (pixel_gaps_.empty()) {
        return find_gaps(pixels, maps);
    }
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (std::isnan(pixel_gaps_[pixel].metres)) {
            asked.push_back(pixel);
        }
    }
    const auto found = find_gaps(asked, maps);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        pixel_gaps_[asked[i]] = found[i];
    }
    std::vector<PixelGap> result;
    result.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        result.push_back(pixel_gaps_[pixel]);
    }
    return result;
}

} // namespace gnomon::analysis
