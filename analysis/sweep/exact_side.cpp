#include "analysis/sweep/exact_side.hpp"

#include "analysis/own_sheets.hpp"

#include <utility>

namespace gnomon::analysis {

ExactSide::ExactSide(const scene::TriangleScene& triangles, std::shared_ptr<SweepSubject> subject,
                     const scene::Job& job, const scene::View& view, const Renderers& renderers)
    : subject_{std::move(subject)},
      view_{view},
      geometry_{triangles, view_, subject_->receivers.triangle},
      light_{renderers.make_exact_light(job, view_, subject_->receivers)},
      distances_{bin_by_distance(subject_->truth.pixel_class,
                                 light_distances_m(subject_->truth.pixel_class, geometry_))},
      remembers_{job.lookup.filter == scene::Filter::nearest},
      causes_{view.image},
      detaches_{view.image, not_asked}
{
}

scene::Image<PixelCause> ExactSide::causes(const CauseInputs& inputs)
{
    return find_causes(inputs, remembers_ ? &causes_ : nullptr);
}

const CentreHits& ExactSide::centre_hits(const CauseInputs& inputs)
{
    if (!centre_hits_) {
        centre_hits_.emplace(inputs);
    }
    return *centre_hits_;
}

std::vector<std::size_t> ExactSide::detached(const CauseInputs& inputs,
                                             std::span<const std::size_t> pixels)
{
    if (!remembers_) {
        return detached_pixels(inputs, pixels);
    }
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (detaches_[pixel] == not_asked) {
            detaches_[pixel] = 0;
            asked.push_back(pixel);
        }
    }
    for (const std::size_t pixel : detached_pixels(inputs, asked)) {
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

} // namespace gnomon::analysis
