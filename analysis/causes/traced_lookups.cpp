#include "analysis/causes/traced_lookups.hpp"

#include "scene/infinity.hpp"
#include "scene/light/facing.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::analysis {

TracedLookups trace_lookups(const CauseInputs& inputs, const scene::LookupLayers& layers,
                            std::span<const std::size_t> pixels)
{
    std::vector<scene::MapPoint> points;
    points.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        points.push_back(layers.at(pixel));
    }
    return trace_lookups(inputs, std::move(points), pixels);
}

TracedLookups trace_lookups(const CauseInputs& inputs, std::vector<scene::MapPoint> points,
                            std::span<const std::size_t> pixels)
{
    const Footprint footprint = inputs.footprint();
    Lookups lookups{{pixels.begin(), pixels.end()}, {}, footprint.tap_count(), {}, {}};
    lookups.taps.reserve(pixels.size() * lookups.taps_each);
    lookups.first_taps.reserve(pixels.size());
    for (const scene::MapPoint& point : points) {
        footprint.append_taps(point, lookups.taps);
        lookups.first_taps.push_back(footprint.first_tap(point));
    }
    lookups.points = std::move(points);
    return {std::move(lookups), inputs.light, inputs.known_hits};
}

std::vector<TapSet> shadowing_taps(const CauseInputs& inputs, const scene::LookupLayers& layers,
                                   const TracedLookups& lookups)
{
    std::vector<TapSet> shadowing(lookups.size());
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        const auto taps = lookups.taps_of(i);
        for (std::size_t t = 0; t < taps.size(); ++t) {
            shadowing[i][t] = inputs.shadows(layers, lookups.pixel(i), taps[t]);
        }
    }
    return shadowing;
}

std::vector<TapSet> own_taps(const renderers::LightQueries& light, const TracedLookups& lookups,
                             std::span<const TapSet> asked)
{
    struct Place {
        std::size_t lookup;
        std::size_t tap;
    };
    std::vector<renderers::SelfShadowingQuery> queries;
    std::vector<Place> places;
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        const auto taps = lookups.taps_of(i);
        const auto hits = lookups.hits_of(i);
        for (std::size_t t = 0; t < taps.size(); ++t) {
            if (asked[i][t] && hits[t] != nullptr && hits[t]->triangle != scene::no_triangle) {
                queries.push_back({lookups.pixel(i), taps[t].texel, hits[t]->triangle});
                places.push_back({i, t});
            }
        }
    }
    const auto is_own = light.are_self_shadowing(queries);
    std::vector<TapSet> own(lookups.size());
    for (std::size_t q = 0; q < queries.size(); ++q) {
        own[places[q].lookup][places[q].tap] = is_own[q] != 0;
    }
    return own;
}

std::vector<float> rerun_biases(const ExactReruns& reruns, const TracedLookups& lookups,
                                LitShare share)
{
    const scene::Image<float>& of_share = share == LitShare::any    ? reruns.any
                                          : share == LitShare::half ? reruns.half
                                                                    : reruns.full;
    std::vector<float> biases(lookups.size());
    for (std::size_t i = 0; i < biases.size(); ++i) {
        biases[i] = of_share[lookups.pixel(i)];
    }
    return biases;
}

using scene::MapPoint;
using scene::Vec2f;

namespace {

/// Whether GL's position is so close to a texel's border, or to the middle between two, that the
/// exact position may lie beyond it. A driver's interpolation error is far below a sixteenth of a
/// texel.
class NearBorders {
public:
    NearBorders(const methods::LookupTraits& traits, double place_error_texels)
        : reach_{place_error_texels + 0x1p-4},
          shift_{traits.interpolates() ? 0.5 : 0.0},
          asks_all_{traits.scatters_taps()}
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
    double shift_; ///< of the positions between which taps change
    bool asks_all_;
};

bool read_the_same(std::span<const Tap> a, std::span<const Tap> b)
{
    return std::ranges::equal(a, b, [](const Tap& tap, const Tap& other) {
        return tap.texel == other.texel && tap.is_inside == other.is_inside;
    });
}

/// On a cube, the face that GL chose is read, up to its seams.
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

namespace {

/// The pixels that are wrong without bias: row-major indices, ascending.
std::vector<std::size_t> wrong_without_bias(const CauseInputs& inputs)
{
    const auto& classes = inputs.truth.pixel_class;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const bool is_lit_truth = scene::is_lit(classes[i]);
        if (scene::is_scored(classes[i]) &&
            scene::is_lit(inputs.unbiased.samples[i].verdict) != is_lit_truth) {
            wrong.push_back(i);
        }
    }
    return wrong;
}

/// Whether each triangle casts and is not culled.
std::vector<std::uint8_t> drawn_to_maps(const scene::TriangleScene& triangles,
                                        const scene::Light& light, scene::Cull cull)
{
    const std::vector<int> facings = scene::facings(triangles, light);
    std::vector<std::uint8_t> drawn(facings.size(), 0);
    for (const scene::TriangleRange& range : casting_ranges(triangles)) {
        for (std::uint32_t t = range.first; t < range.first + range.count; ++t) {
            const bool is_culled = cull == scene::Cull::front  ? facings[t] > 0
                                   : cull == scene::Cull::back ? facings[t] < 0
                                                               : false;
            drawn[t] = is_culled ? 0 : 1;
        }
    }
    return drawn;
}

} // namespace

ExactReruns find_exact_primitives(const CauseInputs& inputs,
                                  const scene::Image<std::uint32_t>& receivers)
{
    const std::vector<std::size_t> pixels = wrong_without_bias(inputs);
    std::vector<scene::MapPoint> points;
    for (const std::size_t pixel : pixels) {
        const bool is_lit = scene::is_lit(inputs.truth.pixel_class[pixel]);
        points.push_back((is_lit ? inputs.of_lit() : inputs.unbiased).at(pixel));
    }
    const TracedLookups lookups = trace_lookups(inputs, std::move(points), pixels);
    scene::Image<float> criticals{receivers.size()};
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        const std::size_t pixel = lookups.pixel(i);
        const renderers::TexelHit* const hit = lookups.hits_of(i).front();
        if (hit == nullptr) {
            criticals[pixel] = inputs.rule.border_critical_bias();
        } else {
            const bool is_lit = hit->triangle == receivers[pixel];
            criticals[pixel] = is_lit ? -scene::infinity : scene::infinity;
        }
    }
    return {criticals, criticals, criticals};
}

scene::Image<std::uint8_t> find_missing_receivers(const CauseInputs& inputs,
                                                  const scene::Image<std::uint32_t>& receivers,
                                                  const scene::TriangleScene& triangles,
                                                  const scene::Light& light, scene::Cull cull)
{
    const std::vector<std::uint8_t> in_maps = drawn_to_maps(triangles, light, cull);
    scene::Image<std::uint8_t> missing{receivers.size()};
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        if (scene::is_scored(inputs.truth.pixel_class[i])) {
            const float depth = inputs.unbiased.samples[i].receiver_depth;
            const bool is_between_planes = depth >= 0 && depth <= 1;
            missing[i] = in_maps[receivers[i]] != 0 && is_between_planes ? 0 : 1;
        }
    }
    return missing;
}

} // namespace gnomon::analysis
