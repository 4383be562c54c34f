#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "scene/image.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The first surface that the light sees through the centre texel of each scored pixel, if it has
/// one. Independent of what the map stores.
class CentreHits {
public:
    /// @throws std::invalid_argument  as `find_lit_causes`.
    explicit CentreHits(const CauseInputs& inputs);
    /// @param find  Finds the first hits of texels, with positions.
    CentreHits(const CauseInputs& inputs, const FindFirstHits& find);

    /// A pixel and the index of its texel's hit.
    struct Seen {
        std::uint32_t pixel = 0;
        std::uint32_t hit = 0;
    };
    [[nodiscard]] const std::vector<Seen>& seen() const { return seen_; }
    [[nodiscard]] const TexelHits& hits() const { return hits_; }
    [[nodiscard]] const renderers::TexelHit& hit(const Seen& seen) const
    {
        return hits_.by_number(seen.hit);
    }
    [[nodiscard]] const scene::Texel& texel(const Seen& seen) const
    {
        return hits_.texel(seen.hit);
    }

private:
    /// Pixels and their centre texels.
    struct Centres {
        std::vector<std::uint32_t> pixels;
        std::vector<scene::Texel> texels;
    };

    CentreHits(const Centres& centres, const FindFirstHits& find);
    static Centres find_centres(const CauseInputs& inputs);

    std::vector<Seen> seen_; ///< in the order of the pixels
    TexelHits hits_;
};

/// The map's depth error at each scored pixel's centre texel [m]: the light distance of the stored
/// depth, minus the exact one of the surface that the light sees through the texel's centre.
///
/// NaN where the pixel is not scored, where there is no texel, or where either sees nothing.
/// @param hits  From the same inputs; stored depths may differ.
/// @param maps  Of the light.
/// Source: docs/depth_precision.md.
[[nodiscard]] scene::Image<float> map_depth_errors_m(const CauseInputs& inputs,
                                                     const CentreHits& hits,
                                                     std::span<const scene::LightFrustum> maps,
                                                     scene::DepthFormat format);

} // namespace gnomon::analysis
