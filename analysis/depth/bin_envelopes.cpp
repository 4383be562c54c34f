#include "analysis/depth/bin_envelopes.hpp"

#include "analysis/depth/depth_error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

/// The largest envelope in a bin, of 65 distances evenly spaced over it: for evenly spaced codes
/// that is the upper edge's, but a float32's falls where its depth meets a power of two.
double largest_in(const DepthMapping& mapping, const DepthCoding& coding, double lower_m,
                  double upper_m)
{
    double largest_m = std::max(error_envelope_m(mapping, coding, lower_m),
                                error_envelope_m(mapping, coding, upper_m));
    constexpr int steps = 64;
    for (int i = 1; i < steps; ++i) {
        const double light_distance_m = std::lerp(lower_m, upper_m, i / double{steps});
        largest_m = std::max(largest_m, error_envelope_m(mapping, coding, light_distance_m));
    }
    return largest_m;
}

} // namespace

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
        bin.envelope_m = largest_in(mapping, coding, within(bin.lower), within(corner * bin.upper));
    }
}

} // namespace gnomon::analysis
