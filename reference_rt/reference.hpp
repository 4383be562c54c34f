#pragma once

#include "reference_rt/reference_scene.hpp"
#include "renderers/reference.hpp"

namespace gnomon::reference_rt {

/// The reference by Embree's traversal and exact predicates.
class EmbreeReference final : public renderers::RoundedReference {
public:
    /// @param scene  serves the method; must outlive this object.
    EmbreeReference(const ReferenceScene& scene, const TruthOptions& options)
        : scene_{scene},
          options_{options}
    {
    }

    [[nodiscard]] scene::Truth find_truth(const scene::View& view,
                                          const scene::ReceiverLayers& receivers,
                                          const renderers::RasterFacts& raster) const override;
    [[nodiscard]] std::string truth_method() const override;
    [[nodiscard]] bool has_light_queries() const override
    {
        return options_.method == TruthMethod::exact;
    }
    [[nodiscard]] std::unique_ptr<renderers::LightQueries>
    make_light_queries(const scene::Job& job, const scene::View& view,
                       const scene::ReceiverLayers& receivers) const override;
    [[nodiscard]] scene::Image<scene::Vec3f> seen_points(const scene::View& view) const override;
    [[nodiscard]] std::vector<scene::NearestSurface>
    nearest_surfaces(std::span<const scene::Vec3d> points,
                     std::span<const scene::SurfaceScope> scopes) const override;
    [[nodiscard]] scene::RoundedTruth
    find_rounded_truth(const scene::Light& light,
                       const scene::RoundedReceivers& receivers) const override;
    [[nodiscard]] std::vector<renderers::BlockerHit>
    find_rounded_blockers(const scene::Light& light, const scene::RoundedReceivers& receivers,
                          const scene::RoundedTruth& truth,
                          std::span<const std::size_t> pixels) const override;

private:
    const ReferenceScene& scene_;
    TruthOptions options_;
};

} // namespace gnomon::reference_rt
