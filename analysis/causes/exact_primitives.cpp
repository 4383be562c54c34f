#include "analysis/causes/exact_primitives.hpp"

#include "analysis/causes/self_shadowing.hpp"
#include "scene/infinity.hpp"
#include "scene/light/facing.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Row-major indices, ascending.
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

/// Of each triangle whether it casts, and the culling leaves it.
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
