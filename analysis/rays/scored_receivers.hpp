#pragma once

#include "analysis/metrics/blocker_gap_cache.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/rays/first_hit_cache.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

namespace gnomon::analysis {

/// What a camera's receivers before a light will be asked.
struct ReceiverUse {
    bool by_many_maps = true; ///< what is found for one map is remembered for the next
    bool counts_cells = true; ///< they are told apart by object and light distance
};

/// A camera before a light: what GL sees there and what is true, and what follows from both
/// whatever the map.
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

    /// To the blockers that this culling leaves.
    [[nodiscard]] BlockerGapCache& gaps(scene::Cull cull);
    [[nodiscard]] FirstHitCache& first_hits() { return first_hits_; }

    /// Light distance of the scored receivers [m], else NaN. This and what follows from it are
    /// found anew only if the frustum's origin or direction changed since the last call.
    [[nodiscard]] std::shared_ptr<const scene::Image<float>>
    light_distance_m(const scene::LightFrustum& frustum, const ReceiverGeometry& geometry);
    /// The scored receivers by light distance.
    [[nodiscard]] std::shared_ptr<const Binning> distances(const scene::LightFrustum& frustum,
                                                           const ReceiverGeometry& geometry);
    /// The same with their objects; no cells if they are not to be counted.
    [[nodiscard]] std::shared_ptr<const CellMap> cells(const scene::LightFrustum& frustum,
                                                       const ReceiverGeometry& geometry,
                                                       const scene::TriangleScene& triangles);

private:
    /// Its pixels see at most one centre texel each of every map: room for maps of this many sizes.
    static constexpr std::size_t texels_each_pixel = 4;

    void count_from(const scene::LightFrustum& frustum);

    const scene::ReceiverLayers& receivers_;
    const scene::Truth& truth_;
    ReceiverUse use_;
    ClassCounts classes_;
    BlockerGapCache gaps_;
    std::map<scene::Cull, BlockerGapCache> culled_gaps_; ///< of those that leave some out
    FirstHitCache first_hits_;
    std::shared_ptr<const scene::Image<float>> light_distance_m_;
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const CellMap> cells_;
    scene::Vec3d distances_from_{}; ///< ζ is 0 there
    scene::Vec3d distances_along_{};
};

} // namespace gnomon::analysis
