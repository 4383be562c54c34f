#pragma once

#include "renderers/light_queries.hpp"
#include "renderers/values.hpp"
#include "scene/image.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon::renderers {

/// Computes the truth for one scene. Answers do not depend on the number of threads.
class Reference {
public:
    Reference() = default;
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;
    virtual ~Reference() = default;

    /// Classifies every pixel of the receivers that a rasterizer drew.
    [[nodiscard]] virtual scene::Truth find_truth(const scene::View& view,
                                                  const scene::ReceiverLayers& receivers,
                                                  const RasterFacts& raster) const = 0;
    /// The name of the truth method, e.g. "exact".
    [[nodiscard]] virtual std::string truth_method() const { return "exact"; }
    /// Whether `make_light_queries` is supported; diagnosis needs it.
    [[nodiscard]] virtual bool has_light_queries() const { return true; }
    /// Queries about the light's rays for the job's map. The result may refer to the arguments.
    [[nodiscard]] virtual std::unique_ptr<LightQueries>
    make_light_queries(const scene::Job& job, const scene::View& view,
                       const scene::ReceiverLayers& receivers) const = 0;
};

/// Computes the truth for another renderer's receivers: points rounded to float32.
class RoundedReference : public Reference {
public:
    /// The point P at each pixel centre of a view, or NaN.
    [[nodiscard]] virtual scene::Image<scene::Vec3f> seen_points(const scene::View& view) const = 0;
    /// @param scopes  for each point; empty for all receiving surfaces.
    [[nodiscard]] virtual std::vector<scene::NearestSurface>
    nearest_surfaces(std::span<const scene::Vec3d> points,
                     std::span<const scene::SurfaceScope> scopes) const = 0;
    [[nodiscard]] virtual scene::RoundedTruth
    find_rounded_truth(const scene::Light& light,
                       const scene::RoundedReceivers& receivers) const = 0;
    /// The blocker of each of these blocked pixels.
    [[nodiscard]] virtual std::vector<BlockerHit>
    find_rounded_blockers(const scene::Light& light, const scene::RoundedReceivers& receivers,
                          const scene::RoundedTruth& truth,
                          std::span<const std::size_t> pixels) const = 0;
};

} // namespace gnomon::renderers
