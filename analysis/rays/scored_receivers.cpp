#include "analysis/rays/scored_receivers.hpp"

namespace gnomon::analysis {

ScoredReceivers::ScoredReceivers(const scene::ReceiverLayers& receivers, const scene::Truth& truth,
                                 const ReceiverUse& use)
    : receivers_{receivers},
      truth_{truth},
      use_{use},
      classes_{count_classes(truth)},
      gaps_{truth.pixel_class.size()},
      first_hits_{use.by_many_maps ? texels_each_pixel * truth.pixel_class.pixel_count() : 0}
{
}

BlockerGapCache& ScoredReceivers::gaps(scene::Cull cull)
{
    if (cull == scene::Cull::none) {
        return gaps_;
    }
    return culled_gaps_.try_emplace(cull, truth_.pixel_class.size(), cull).first->second;
}

void ScoredReceivers::count_from(const scene::LightFrustum& frustum)
{
    if (distances_from_ != frustum.origin || distances_along_ != frustum.forward) {
        light_distance_m_ = nullptr;
        distances_ = nullptr;
        cells_ = nullptr;
        distances_from_ = frustum.origin;
        distances_along_ = frustum.forward;
    }
}

std::shared_ptr<const scene::Image<float>>
ScoredReceivers::light_distance_m(const scene::LightFrustum& frustum,
                                  const ReceiverGeometry& geometry)
{
    count_from(frustum);
    if (light_distance_m_ == nullptr) {
        light_distance_m_ = std::make_shared<const scene::Image<float>>(
            light_distances_m(truth_.pixel_class, geometry));
    }
    return light_distance_m_;
}

std::shared_ptr<const Binning> ScoredReceivers::distances(const scene::LightFrustum& frustum,
                                                          const ReceiverGeometry& geometry)
{
    count_from(frustum);
    if (distances_ == nullptr) {
        distances_ = std::make_shared<const Binning>(
            bin_by_distance(truth_.pixel_class, *light_distance_m(frustum, geometry)));
    }
    return distances_;
}

std::shared_ptr<const CellMap> ScoredReceivers::cells(const scene::LightFrustum& frustum,
                                                      const ReceiverGeometry& geometry,
                                                      const scene::TriangleScene& triangles)
{
    count_from(frustum);
    if (cells_ == nullptr) {
        const auto& classes = truth_.pixel_class;
        cells_ = std::make_shared<const CellMap>(
            use_.counts_cells
                ? find_error_buckets(classes, receivers_.triangle,
                                     *light_distance_m(frustum, geometry), triangles)
                : CellMap{scene::Image<std::uint16_t>{classes.size(), CellMap::none}, {}});
    }
    return cells_;
}

} // namespace gnomon::analysis
