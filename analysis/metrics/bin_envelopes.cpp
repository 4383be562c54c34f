#include "analysis/metrics/bin_envelopes.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>

namespace gnomon::analysis {

namespace {

/// The largest error of a map's depths between two light distances.
class Envelope {
public:
    Envelope(const scene::LightFrustum& frustum, scene::DepthFormat format)
        : frustum_{frustum},
          mapping_{frustum.stored_range()},
          coding_{DepthCoding::of(format)},
          corner_{frustum.largest_per_light_distance()}
    {
    }

    [[nodiscard]] double within(double lower_m, double upper_m) const
    {
        const auto inside = [&](double light_distance_m) {
            return std::clamp(light_distance_m, frustum_.near_m, frustum_.far_m);
        };
        const auto [light_distance_m, tolerance] =
            coarsest_depth(mapping_, coding_, inside(lower_m), inside(corner_ * upper_m));
        return mapping_.largest_light_distance_error_m(light_distance_m, tolerance);
    }

private:
    const scene::LightFrustum& frustum_;
    DepthMapping mapping_;
    DepthCoding coding_;
    /// A receiver is as far from the light as its ζ, or up to a map's corner farther.
    double corner_;
};

} // namespace

void add_envelopes(std::vector<ErrorBin>& by_distance, std::span<const scene::LightFrustum> maps,
                   scene::DepthFormat format)
{
    for (const scene::LightFrustum& map : maps) {
        const Envelope envelope{map, format};
        for (ErrorBin& bin : by_distance) {
            bin.envelope_m =
                std::max(bin.envelope_m.value_or(0), envelope.within(bin.lower, bin.upper));
        }
    }
}

} // namespace gnomon::analysis
