#include "analysis/causes/exact_primitives.hpp"

#include "analysis/causes/self_shadowing.hpp"
#include "scene/infinity.hpp"
#include "scene/pixel_class.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Row-major indices, ascending.
std::vector<std::size_t> wrong_without_bias(const CauseInputs& inputs)
{
    const auto& classes = inputs.truth.pixel_class;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const bool is_lit_truth = classes[i] == scene::PixelClass::lit;
        if (scene::is_scored(classes[i]) &&
            scene::is_lit(inputs.unbiased.samples[i].verdict) != is_lit_truth) {
            wrong.push_back(i);
        }
    }
    return wrong;
}

} // namespace

ExactReruns find_exact_primitives(const CauseInputs& inputs,
                                  const scene::Image<std::uint32_t>& receivers)
{
    const std::vector<std::size_t> pixels = wrong_without_bias(inputs);
    const TracedLookups lookups = trace_lookups(inputs, inputs.unbiased, pixels);
    scene::Image<float> criticals{receivers.size()};
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        const std::size_t pixel = lookups.pixel(i);
        const scene::TexelHit* const hit = lookups.hits_of(i).front();
        if (hit == nullptr) {
            criticals[pixel] = inputs.rule.border_critical_bias();
        } else {
            const bool is_lit = hit->triangle == receivers[pixel];
            criticals[pixel] = is_lit ? -scene::infinity : scene::infinity;
        }
    }
    return {criticals, criticals, criticals};
}

} // namespace gnomon::analysis
