#pragma once

#include "analysis/causes/cause_cache.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/metrics/map_errors.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/pixels/quantiles.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
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

/// What exact rays say of the receivers' lookups in maps that differ in nothing but the depth
/// format, and what methods and filters make of them: found once, when it is first asked for.
class LightQueryCache {
public:
    /// @param view  of any of the jobs; no bias matters but those that move lookups.
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
    /// receivers', or any of them where lengths are the same everywhere (a directional light's);
    /// empty if there are none.
    [[nodiscard]] std::optional<double> representative_light_distance_m();
    /// The scored receivers by light distance.
    [[nodiscard]] const Binning& distances() const { return *distances_; }
    /// The scored receivers by object and light distance; no cells where they are too many or not
    /// to be counted.
    [[nodiscard]] const CellMap& cells();
    /// To the blockers, whatever is culled.
    [[nodiscard]] BlockerGapCache& gaps() { return receivers_->gaps(scene::Cull::none); }
    /// The gaps of these blocked pixels to what the maps' culling leaves, in the order of the
    /// pixels.
    /// @param maps  that their lookups read.
    [[nodiscard]] std::vector<PixelGap> pixel_gaps(std::span<const std::size_t> pixels,
                                                   const scene::MapIndices& maps);

    /// `find_lit_causes`, with what is known of other formats.
    void find_lit(const CauseInputs& inputs, PixelCauses& causes);
    /// `find_blocked_causes`, the same.
    void find_blocked(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                      PixelCauses& causes);
    /// What the light sees through each scored pixel's centre texel; traced when first asked for.
    [[nodiscard]] const CentreHits& centre_hits(const CauseInputs& inputs);
    /// What a method that compares no depths is run over.
    /// @param places  in each texel, whose depths it reads.
    /// @param layers  surfaces there, one behind the other.
    [[nodiscard]] renderers::ExactDepths
    exact_depths(const CauseInputs& inputs, std::span<const scene::Vec2d> places, int layers);
    /// Lets go of `centre_hits`; they are traced again if they are asked for.
    void forget_texels() { centre_hits_.reset(); }

private:
    static constexpr PixelGap unknown_gap{std::numeric_limits<float>::quiet_NaN(), 0};

    /// The image's size where `is_kept`, else that of an image without pixels.
    [[nodiscard]] scene::ImageSize size_if(bool is_kept) const;
    /// What is remembered of lookups like these, or nullptr: only with a single tap what is found
    /// does not depend on the stored depths.
    [[nodiscard]] CauseCache* causes_of(const CauseInputs& inputs);
    /// The same, with what is known of texels.
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
    std::optional<Quantiles>
        light_distance_quantiles_m_; ///< empty until asked for, or without receivers
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const CellMap> cells_; ///< nullptr until asked for
    std::optional<CentreHits> centre_hits_;
    std::optional<ExactDepthCache> exact_depths_; ///< empty until asked for
    std::optional<CauseCache> causes_;            ///< likewise
    scene::Image<PixelGap> pixel_gaps_;           ///< or `unknown_gap`; empty: not remembered
};

} // namespace gnomon::analysis
