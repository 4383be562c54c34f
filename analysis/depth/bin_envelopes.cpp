#include "analysis/depth/bin_envelopes.hpp"

#include "analysis/depth/depth_error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::analysis {

void add_envelopes(std::vector<ErrorBin>& by_distance, const scene::LightFrustum& frustum,
                   scene::DepthFormat format)
{
    const DepthMapping mapping{frustum.stored_range()};
    // A receiver is as far from the light as its ζ, or up to a map's corner farther.
    const double corner = frustum.content == scene::MapContent::depth
                              ? 1
                              : glm::length(scene::Vec3d{frustum.right_side, frustum.top, 1});
    const DepthCoding coding = DepthCoding::of(format);
    const auto within = [&](double light_distance_m) {
        return std::clamp(light_distance_m, frustum.near_m, frustum.far_m);
    };
    for (ErrorBin& bin : by_distance) {
        const auto [light_distance_m, tolerance] =
            coarsest_depth(mapping, coding, within(bin.lower), within(corner * bin.upper));
        bin.envelope_m = mapping.largest_light_distance_error_m(light_distance_m, tolerance);
    }
}

} // namespace gnomon::analysis
