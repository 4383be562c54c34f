#include "analysis/causes/self_shadowing.hpp"

#include <utility>

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

} // namespace gnomon::analysis
