#pragma once

#include "analysis/causes.hpp"
#include "analysis/texel_hits.hpp"
#include "scene/image.hpp"
#include "scene/job.hpp"
#include "scene/light_frustum.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// What the light sees through the centre texel of each scored pixel that has one; it does not
/// depend on what the map stores.
class CentreHits {
public:
    /// @throws std::invalid_argument  as `find_causes` does.
    explicit CentreHits(const CauseInputs& inputs);

    struct Seen {
        std::size_t pixel = 0;
        scene::Texel texel;
        std::uint32_t hit = 0; ///< its number
    };
    [[nodiscard]] const std::vector<Seen>& seen() const { return seen_; }
    [[nodiscard]] const TexelHits& hits() const { return hits_; }
    [[nodiscard]] const scene::TexelHit& hit(const Seen& seen) const
    {
        return hits_.by_number(seen.hit);
    }

private:
    std::vector<Seen> seen_; ///< by pixel
    TexelHits hits_;
};

/// The depth error of the map at each scored pixel's centre texel: light distance that the stored
/// depth stands for, less the exact one of what the light sees through the texel's centre [m].
///
/// NaN where the pixel is not scored, where there is no texel, or where either sees nothing.
/// @param hits  of the same inputs, whatever their stored depths.
/// Source: DESIGN §6.
[[nodiscard]] scene::Image<float> map_depth_errors_m(const CauseInputs& inputs,
                                                     const CentreHits& hits,
                                                     const scene::LightFrustum& frustum,
                                                     scene::DepthFormat format);

} // namespace gnomon::analysis
