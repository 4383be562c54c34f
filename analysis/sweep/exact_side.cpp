#include "analysis/sweep/exact_side.hpp"

#include "analysis/own_sheets.hpp"

#include <cmath>
#include <utility>

namespace gnomon::analysis {

void SweepSubject::count_from(const scene::LightFrustum& frustum)
{
    if (distances_from_ != frustum.origin || distances_along_ != frustum.forward) {
        distances_ = nullptr;
        parts_ = nullptr;
        distances_from_ = frustum.origin;
        distances_along_ = frustum.forward;
    }
}

std::shared_ptr<const Binning> SweepSubject::distances(const scene::LightFrustum& frustum,
                                                       const ReceiverGeometry& geometry)
{
    count_from(frustum);
    if (distances_ == nullptr) {
        distances_ = std::make_shared<const Binning>(
            bin_by_distance(truth.pixel_class, light_distances_m(truth.pixel_class, geometry)));
    }
    return distances_;
}

std::shared_ptr<const PartMap> SweepSubject::parts(const scene::LightFrustum& frustum,
                                                   const ReceiverGeometry& geometry,
                                                   const scene::TriangleScene& triangles)
{
    count_from(frustum);
    if (parts_ == nullptr) {
        parts_ = std::make_shared<const PartMap>(
            counts_parts_
                ? find_parts(truth.pixel_class, receivers.triangle,
                             light_distances_m(truth.pixel_class, geometry), triangles)
                : PartMap{scene::Image<std::uint16_t>{truth.pixel_class.size(), PartMap::none},
                          {}});
    }
    return parts_;
}

ExactSide::ExactSide(const scene::TriangleScene& triangles, std::shared_ptr<SweepSubject> subject,
                     const scene::Job& job, const scene::View& view, const Renderers& renderers)
    : subject_{std::move(subject)},
      view_{view},
      resolution_texels_{job.shadow_map.resolution_texels},
      cull_{job.shadow_map.cull},
      geometry_{triangles, view_, subject_->receivers.triangle},
      light_{renderers.make_exact_light(job, view_, subject_->receivers)},
      distances_{subject_->distances(view_.frustum, geometry_)},
      parts_{subject_->parts(view_.frustum, geometry_, triangles)},
      remembers_{job.lookup.filter == scene::Filter::nearest},
      causes_{view.image},
      detaches_{view.image, not_asked},
      pixel_gaps_{view.image, unknown_gap}
{
}

CauseInputs ExactSide::with_known_hits(CauseInputs inputs)
{
    inputs.known_hits = &centre_hits(inputs).hits();
    return inputs;
}

scene::Image<PixelCause> ExactSide::causes(const CauseInputs& inputs)
{
    return find_causes(with_known_hits(inputs), remembers_ ? &causes_ : nullptr);
}

const CentreHits& ExactSide::centre_hits(const CauseInputs& inputs)
{
    if (!centre_hits_) {
        centre_hits_.emplace(inputs, [&](std::span<const scene::Texel> texels) {
            return subject_->first_hits.first_hits(
                {*light_, view_.frustum, resolution_texels_, cull_}, texels);
        });
    }
    return *centre_hits_;
}

std::vector<std::size_t> ExactSide::detached(const CauseInputs& inputs,
                                             std::span<const std::size_t> pixels)
{
    if (!remembers_) {
        return detached_pixels(with_known_hits(inputs), pixels);
    }
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (detaches_[pixel] == not_asked) {
            detaches_[pixel] = 0;
            asked.push_back(pixel);
        }
    }
    for (const std::size_t pixel : detached_pixels(with_known_hits(inputs), asked)) {
        detaches_[pixel] = 1;
    }
    std::vector<std::size_t> detached;
    for (const std::size_t pixel : pixels) {
        if (detaches_[pixel] == 1) {
            detached.push_back(pixel);
        }
    }
    return detached;
}

std::vector<PixelGap> ExactSide::pixel_gaps(std::span<const std::size_t> pixels)
{
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (std::isnan(pixel_gaps_[pixel].metres)) {
            asked.push_back(pixel);
        }
    }
    gaps().find(*light_, asked);
    const auto found = gaps_of_pixels(gaps(), asked, geometry_, view_.frustum, resolution_texels_);
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
