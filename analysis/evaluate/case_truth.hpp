#pragma once

#include "scene/job/job.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/pixel_layers.hpp"
#include "scene/view/rounded_receivers.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What knows the truth of a case's scene, as callables: `analysis` needs no Embree.
struct CaseTruth {
    /// One scope for each point, or none: all that receive.
    std::function<std::vector<scene::NearestSurface>(std::span<const scene::Vec3d>,
                                                     std::span<const scene::SurfaceScope>)>
        nearest_surfaces;
    /// What the pixel centres of a view show: P, or NaN.
    std::function<scene::Image<scene::Vec3f>(const scene::View&)> seen_points;
    std::function<scene::RoundedTruth(const scene::Light&, const scene::RoundedReceivers&)>
        find_truth;
    std::function<std::vector<scene::BlockerHit>(
        const scene::Light&, const scene::RoundedReceivers&, const scene::RoundedTruth&,
        std::span<const std::size_t>)>
        find_blockers;
    /// As in `Renderers`.
    std::function<std::unique_ptr<scene::ExactLight>(const scene::Job&, const scene::View&,
                                                     const scene::ReceiverLayers&)>
        make_exact_light;
    std::string embree; ///< "Embree 3.13.5"
    std::string gnomon; ///< version
};

} // namespace gnomon::analysis
