#pragma once

#include "analysis/limits/bias_limits.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/pixels/statistics.hpp"
#include "renderers/light_queries.hpp"
#include "scene/image.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Caches the world distances from blocked receivers to their blockers, among the triangles that a
/// culling leaves. They depend only on scene, camera and light, so that one cache serves all maps.
class BlockerGapCache {
public:
    explicit BlockerGapCache(scene::ImageSize size, scene::Cull cull = scene::Cull::none);

    /// Finds the gaps of those pixels that are not known yet.
    /// @param pixels  Blocked in truth.
    void find(const renderers::LightQueries& light, std::span<const std::size_t> pixels);
    /// Distance from P to its blocker [m]; infinite if the culling leaves none. Precondition:
    /// `find` was called for the pixel.
    [[nodiscard]] double gap_m(std::size_t pixel) const { return gaps_m_[pixel]; }

private:
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    scene::Image<double> gaps_m_;
    scene::Cull cull_;
};

/// Forgives gaps of at most the pixel's own width. The arguments must outlive the result.
[[nodiscard]] ForgiveGaps forgive_footprints(BlockerGapCache& gaps,
                                             const renderers::LightQueries& light,
                                             const ReceiverGeometry& geometry);

/// Length of one pixel's peter-panning gap.
struct PixelGap {
    float metres = 0; ///< from P to its blocker; infinite if the culling leaves none
    float texels = 0; ///< in world-space texel widths at P
};

/// Quantiles of the peter-panning gaps; empty if no pixel has one.
struct Gaps {
    std::optional<Quantiles> metres;
    std::optional<Quantiles> texels;
};

/// @param pixels  Blocked in truth; their gaps must be known.
[[nodiscard]] std::vector<PixelGap> gaps_of_pixels(const BlockerGapCache& gaps,
                                                   std::span<const std::size_t> pixels,
                                                   const ReceiverGeometry& geometry,
                                                   const MapsOfPixels& maps);

/// A pixel whose shadow detaches when the bias is at least `critical_bias`.
struct PanningGap {
    float critical_bias = 0;
    PixelGap gap; ///< regardless of the bias's reach
    std::size_t pixel = 0;
};

/// The reach of a pixel's biases at a constant bias [m]; does not decrease with it.
using BiasReach = std::function<double(std::size_t pixel, float bias)>;

/// The peter-panning gaps at each bias, limited to the reach of the biases.
/// @param biases  Ascending.
/// @param reach   Empty: unlimited.
[[nodiscard]] std::vector<Gaps> find_gaps_at(std::vector<PanningGap> gaps,
                                             std::span<const float> biases, const BiasReach& reach);

} // namespace gnomon::analysis
