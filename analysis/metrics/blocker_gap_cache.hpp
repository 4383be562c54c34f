#pragma once

#include "analysis/limits/bias_limits.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "renderers/light_queries.hpp"
#include "scene/image.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <limits>
#include <span>

namespace gnomon::analysis {

/// World distances from blocked receivers to their blockers among the triangles that a culling
/// leaves, found when first asked for. They depend on scene, camera and light beside: one memory
/// serves all maps.
class BlockerGapCache {
public:
    explicit BlockerGapCache(scene::ImageSize size, scene::Cull cull = scene::Cull::none);

    /// Finds those of the pixels that are not known yet.
    /// @param pixels  blocked in truth.
    void find(const renderers::LightQueries& light, std::span<const std::size_t> pixels);
    /// From P to its blocker [m]; infinite where the culling leaves none. Precondition: it was
    /// found.
    [[nodiscard]] double gap_m(std::size_t pixel) const { return gaps_m_[pixel]; }

private:
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    scene::Image<double> gaps_m_;
    scene::Cull cull_;
};

/// Forgives gaps of at most the pixel's own width. The arguments must outlive what is returned.
[[nodiscard]] ForgiveGaps forgive_footprints(BlockerGapCache& gaps,
                                             const renderers::LightQueries& light,
                                             const ReceiverGeometry& geometry);

} // namespace gnomon::analysis
