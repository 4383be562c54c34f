#include "analysis/depth/bin_envelopes.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>

namespace gnomon::analysis {

void add_envelopes(std::vector<ErrorBin>& by_distance, const scene::LightFrustum& frustum,
                   scene::DepthFormat format)
{
    const DepthMapping mapping{frustum.depth_range()};
    const DepthCoding coding = DepthCoding::of(format);
    for (ErrorBin& bin : by_distance) {
        bin.envelope_m =
            error_envelope_m(mapping, coding, std::clamp(bin.upper, frustum.near_m, frustum.far_m));
    }
}

} // namespace gnomon::analysis
