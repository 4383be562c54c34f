#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/rays/first_hit_cache.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

namespace gnomon::analysis {

/// How a camera's receivers under a light will be used.
struct ReceiverUse {
    bool by_many_maps = true; ///< cache results of one map for the next
    bool counts_cells = true; ///< distinguish receivers by object and light distance
};

/// The receivers of a camera under a light: what GL sees, the truth, and results that follow from
/// both for any map.
class ScoredReceivers {
public:
    /// @param receivers, truth  Must outlive this.
    ScoredReceivers(const scene::ReceiverLayers& receivers, const scene::Truth& truth,
                    const ReceiverUse& use);
    ScoredReceivers(const ScoredReceivers&) = delete;
    ScoredReceivers& operator=(const ScoredReceivers&) = delete;

    [[nodiscard]] const scene::ReceiverLayers& receivers() const { return receivers_; }
    [[nodiscard]] const scene::Truth& truth() const { return truth_; }
    [[nodiscard]] const ClassCounts& classes() const { return classes_; }
    [[nodiscard]] const ReceiverUse& use() const { return use_; }

    /// Gaps to the blockers that this culling leaves.
    [[nodiscard]] BlockerGapCache& gaps(scene::Cull cull);
    [[nodiscard]] FirstHitCache& first_hits() { return first_hits_; }

    /// Light distance of the scored receivers [m], else NaN. Recomputed, with all that depends on
    /// it, only if the frustum's origin or direction has changed since the last call.
    [[nodiscard]] std::shared_ptr<const scene::Image<float>>
    light_distance_m(const scene::LightFrustum& frustum, const ReceiverGeometry& geometry);
    /// The scored receivers by light distance.
    [[nodiscard]] std::shared_ptr<const Binning> distances(const scene::LightFrustum& frustum,
                                                           const ReceiverGeometry& geometry);
    /// The scored receivers by object and light distance; no cells if they are not wanted.
    [[nodiscard]] std::shared_ptr<const CellMap> cells(const scene::LightFrustum& frustum,
                                                       const ReceiverGeometry& geometry,
                                                       const scene::TriangleScene& triangles);

private:
    /// Capacity for maps of this many sizes: a pixel has at most one centre texel in each map.
    static constexpr std::size_t texels_each_pixel = 4;

    void count_from(const scene::LightFrustum& frustum);

    const scene::ReceiverLayers& receivers_;
    const scene::Truth& truth_;
    ReceiverUse use_;
    ClassCounts classes_;
    BlockerGapCache gaps_;
    std::map<scene::Cull, BlockerGapCache> culled_gaps_; ///< for each culling other than none
    FirstHitCache first_hits_;
    std::shared_ptr<const scene::Image<float>> light_distance_m_;
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const CellMap> cells_;
    scene::Vec3d distances_from_{}; ///< where ζ is 0
    scene::Vec3d distances_along_{};
};

} // namespace gnomon::analysis
