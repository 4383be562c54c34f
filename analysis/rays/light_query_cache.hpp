#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/find_causes.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/metrics/map_depth_errors.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/pixels/statistics.hpp"
#include "analysis/rays/exact_depths.hpp"
#include "analysis/rays/scored_receivers.hpp"
#include "renderers/light_queries.hpp"
#include "renderers/reference.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Caches what exact rays tell about the receivers' lookups. Serves all maps that differ only in
/// the depth format, and all methods and filters. Finds each result on first use.
class LightQueryCache {
public:
    /// @param view  Of any of the jobs; only biases that move lookups matter.
    LightQueryCache(const scene::TriangleScene& triangles,
                    std::shared_ptr<ScoredReceivers> receivers, const scene::Job& job,
                    const scene::View& view, const renderers::Reference& reference);
    LightQueryCache(const LightQueryCache&) = delete;
    LightQueryCache& operator=(const LightQueryCache&) = delete;

    [[nodiscard]] const ScoredReceivers& receivers() const { return *receivers_; }
    [[nodiscard]] const scene::TriangleScene& triangles() const { return triangles_; }
    [[nodiscard]] const renderers::LightQueries& light() const { return *light_; }
    [[nodiscard]] const ReceiverGeometry& geometry() const { return geometry_; }
    /// Light distance of the scored receivers [m], else NaN.
    [[nodiscard]] const scene::Image<float>& light_distance_m() const { return *light_distance_m_; }
    /// The light distance at which biases are converted to lengths [m]: the median of the scored
    /// receivers. For a directional light any of them, since lengths are constant. Empty without
    /// scored receivers.
    [[nodiscard]] std::optional<double> representative_light_distance_m();
    /// The scored receivers by light distance.
    [[nodiscard]] const Binning& distances() const { return *distances_; }
    /// The scored receivers by object and light distance. No cells if there are too many or if they
    /// are not wanted.
    [[nodiscard]] const CellMap& cells();
    /// Gaps to the blockers, ignoring culling.
    [[nodiscard]] BlockerGapCache& gaps() { return receivers_->gaps(scene::Cull::none); }
    /// Gaps from these blocked pixels to what the maps' culling leaves, in the order of the pixels.
    /// @param maps  The map that each lookup reads.
    [[nodiscard]] std::vector<PixelGap> pixel_gaps(std::span<const std::size_t> pixels,
                                                   const scene::MapIndices& maps);

    /// `find_lit_causes`, reusing results of other formats.
    void find_lit(const CauseInputs& inputs, PixelCauses& causes);
    /// `find_blocked_causes`, reusing results of other formats.
    void find_blocked(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                      PixelCauses& causes);
    /// The surface that the light sees through each scored pixel's centre texel; traced on first
    /// use.
    [[nodiscard]] const CentreHits& centre_hits(const CauseInputs& inputs);
    /// The exact depths for running a method that does not compare depths.
    /// @param places  Positions within each texel.
    /// @param layers  Number of surfaces, one behind the other.
    [[nodiscard]] renderers::ExactDepths
    exact_depths(const CauseInputs& inputs, std::span<const scene::Vec2d> places, int layers);
    /// Frees `centre_hits`; they are traced again if needed.
    void forget_texels() { centre_hits_.reset(); }

private:
    static constexpr PixelGap unknown_gap{std::numeric_limits<float>::quiet_NaN(), 0};

    /// The image's size if `is_kept`, else an empty size.
    [[nodiscard]] scene::ImageSize size_if(bool is_kept) const;
    /// The cache for lookups like these. Null with several taps, since results then depend on
    /// stored depths.
    [[nodiscard]] CauseCache* causes_of(const CauseInputs& inputs);
    /// Adds the known first hits of texels.
    [[nodiscard]] CauseInputs with_known_hits(CauseInputs inputs);
    [[nodiscard]] std::vector<PixelGap> find_gaps(std::span<const std::size_t> pixels,
                                                  const scene::MapIndices& maps);

    std::shared_ptr<ScoredReceivers> receivers_;
    const scene::TriangleScene& triangles_;
    scene::View view_;
    int resolution_texels_;
    scene::Cull cull_;
    ReceiverGeometry geometry_;
    std::unique_ptr<renderers::LightQueries> light_;
    std::shared_ptr<const scene::Image<float>> light_distance_m_;
    /// Empty until needed, or without receivers.
    std::optional<Quantiles> light_distance_quantiles_m_;
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const CellMap> cells_; ///< null until needed
    std::optional<CentreHits> centre_hits_;
    std::optional<ExactDepthCache> exact_depths_; ///< empty until needed
    std::optional<CauseCache> causes_;            ///< empty until needed
    scene::Image<PixelGap> pixel_gaps_; ///< `unknown_gap` where not found yet; empty if not cached
};

} // namespace gnomon::analysis
