#include "analysis/causes/displaced_lookups.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

using scene::MapPoint;
using scene::Vec2f;

namespace {

/// Whether GL's place is so near to a texel's border, or the middle between two, that the exact one
/// may be beyond it. What a driver's interpolation adds is far less than a sixteenth of a texel.
class NearBorders {
public:
    NearBorders(const methods::LookupTraits& promised, double place_error_texels)
        : reach_{place_error_texels + 0x1p-4},
          shift_{promised.interpolates() ? 0.5 : 0.0},
          asks_all_{promised.scatters_taps()}
    {
    }
    [[nodiscard]] bool has(const Vec2f& place) const
    {
        return asks_all_ || is_near(double{place.x}) || is_near(double{place.y});
    }

private:
    [[nodiscard]] bool is_near(double place) const
    {
        const double beyond = place - shift_;
        return std::abs(beyond - std::nearbyint(beyond)) <= reach_;
    }

    double reach_;
    double shift_; ///< of what taps lie around
    bool asks_all_;
};

bool read_the_same(std::span<const Tap> a, std::span<const Tap> b)
{
    return std::ranges::equal(a, b, [](const Tap& tap, const Tap& other) {
        return tap.texel == other.texel && tap.is_inside == other.is_inside;
    });
}

/// On a cube the face that GL chose, up to its seams, is read.
Vec2f on_face(const Vec2f& place, const CauseInputs& inputs)
{
    if (inputs.rule.edge() != MapEdge::seam) {
        return place;
    }
    const float last = std::nextafter(static_cast<float>(inputs.resolution_texels), 0.0F);
    return {std::clamp(place.x, 0.0F, last), std::clamp(place.y, 0.0F, last)};
}

} // namespace

DisplacedLookups find_displaced(const CauseInputs& inputs, const scene::LookupLayers& layers,
                                std::span<const std::size_t> pixels,
                                const scene::Image<scene::Vec4f>* moved)
{
    const NearBorders near{inputs.rule.traits, inputs.light.place_error_texels()};
    std::vector<std::size_t> indices;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (near.has(layers.texels[pixels[i]])) {
            indices.push_back(i);
            asked.push_back(pixels[i]);
        }
    }
    const Footprint footprint = inputs.footprint();
    const auto places = inputs.light.map_places(asked, layers.maps, moved);
    DisplacedLookups found;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const MapPoint gl = layers.at(asked[i]);
        const MapPoint exact{on_face(places[i], inputs), gl.map, gl.kernel_axis};
        const auto taps = footprint.taps(exact);
        const bool is_point = !std::isnan(exact.texel.x) && !std::isnan(exact.texel.y);
        if (!is_point || read_the_same(footprint.taps(gl), taps)) {
            continue;
        }
        if (inputs.rule.border_decides(layers.samples[asked[i]].receiver_depth, taps)) {
            found.of_border.push_back(indices[i]);
            continue;
        }
        found.points.push_back(exact);
        found.indices.push_back(indices[i]);
        found.pixels.push_back(asked[i]);
    }
    return found;
}

} // namespace gnomon::analysis
