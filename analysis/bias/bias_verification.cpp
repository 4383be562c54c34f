#include "analysis/bias/bias_verification.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

using Rerun = BiasVerification::Rerun;

std::vector<float> sorted_set(std::vector<float> values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// The finite critical biases of pixels with a receiver, ascending, without repetitions.
std::vector<float> finite_criticals(const scene::Image<float>& criticals,
                                    const scene::Image<std::uint32_t>& triangles)
{
    std::vector<float> finite;
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle && std::isfinite(criticals[i])) {
            finite.push_back(criticals[i]);
        }
    }
    return sorted_set(std::move(finite));
}

void require_image_size(std::string_view argument, scene::ImageSize size, scene::ImageSize expected)
{
    if (size != expected) {
        throw std::invalid_argument(
            fmt::format("verify_biases: {}: differs from the image in size", argument));
    }
}

} // namespace

Rerun compare_with_curve(const scene::LookupLayers& lookup,
                         const scene::Image<std::uint32_t>& triangles,
                         const scene::Image<float>& criticals, float bias)
{
    require_image_size("criticals", criticals.size(), triangles.size());
    require_image_size("lookup", lookup.samples.size(), triangles.size());
    Rerun rerun{.bias = bias};
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            continue;
        }
        const bool is_lit = scene::is_lit(lookup.samples[i].verdict);
        ++(is_lit ? rerun.lit : rerun.shadowed);
        rerun.differences += is_lit != (criticals[i] <= bias) ? 1U : 0U;
    }
    return rerun;
}

std::uint64_t BiasVerification::verdicts() const
{
    return std::accumulate(
        reruns.begin(), reruns.end(), std::uint64_t{0},
        [](std::uint64_t sum, const Rerun& rerun) { return sum + rerun.lit + rerun.shadowed; });
}

std::uint64_t BiasVerification::differences() const
{
    return std::accumulate(
        reruns.begin(), reruns.end(), std::uint64_t{0},
        [](std::uint64_t sum, const Rerun& rerun) { return sum + rerun.differences; });
}

void add_reruns(std::optional<BiasVerification>& known, BiasVerification more)
{
    if (!known) {
        known = std::move(more);
        return;
    }
    known->reruns.insert(known->reruns.end(), more.reruns.begin(), more.reruns.end());
    std::ranges::stable_sort(known->reruns, {}, &Rerun::bias);
}

std::vector<float> biases_to_verify(const scene::Image<float>& criticals,
                                    const scene::Image<std::uint32_t>& triangles,
                                    std::span<const float> wanted)
{
    require_image_size("criticals", criticals.size(), triangles.size());
    constexpr std::size_t most_turns = 5;
    const std::vector<float> turns = finite_criticals(criticals, triangles);
    std::vector<float> biases{wanted.begin(), wanted.end()};
    const std::size_t count = std::min(turns.size(), most_turns);
    for (std::size_t i = 0; i < count; ++i) {
        const float turn = turns[count == 1 ? 0 : i * (turns.size() - 1) / (count - 1)];
        for (const float bias : {previous_bias(turn), turn, next_bias(turn)}) {
            if (std::isfinite(bias)) {
                biases.push_back(bias);
            }
        }
    }
    return sorted_set(std::move(biases));
}

BiasVerification verify_biases(const scene::Image<std::uint32_t>& triangles,
                               const scene::Image<float>& criticals, std::span<const float> biases,
                               const std::function<scene::LookupLayers(float constant)>& look_up)
{
    BiasVerification verification;
    for (const float bias : biases) {
        verification.reruns.push_back(
            compare_with_curve(look_up(bias), triangles, criticals, bias));
    }
    return verification;
}

} // namespace gnomon::analysis
