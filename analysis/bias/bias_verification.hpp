#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Compares GL's own lookups at other constant biases with the critical biases.
struct BiasVerification {
    /// One lookup, over all pixels with a receiver.
    struct Rerun {
        float bias = 0; ///< depth units
        std::uint64_t lit = 0;
        std::uint64_t shadowed = 0;
        std::uint64_t differences = 0; ///< verdicts that contradict the critical biases
    };
    std::vector<Rerun> reruns; ///< ascending biases

    [[nodiscard]] std::uint64_t verdicts() const;
    [[nodiscard]] std::uint64_t differences() const;
};

/// Adds lookups to those in `known`, which may be empty.
void add_reruns(std::optional<BiasVerification>& known, BiasVerification more);

/// Constant biases that test the critical biases. They include the wanted ones. Further ones lie
/// at, just below and just above five critical biases: the smallest, the largest, and three evenly
/// spaced by rank in between.
/// @param criticals  `critical_biases`; infinite ones change at no bias.
/// @param triangles  Of the receivers; pixels without one are ignored.
/// @param wanted     Biases to include.
/// @return  Ascending, without repetitions.
[[nodiscard]] std::vector<float> biases_to_verify(const scene::Image<float>& criticals,
                                                  const scene::Image<std::uint32_t>& triangles,
                                                  std::span<const float> wanted);

/// Compares every verdict of a lookup at this constant bias with the pixel's critical bias: lit iff
/// it is at most the bias.
/// @param criticals, triangles  As for `biases_to_verify`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] BiasVerification::Rerun
compare_with_curve(const scene::LookupLayers& lookup, const scene::Image<std::uint32_t>& triangles,
                   const scene::Image<float>& criticals, float bias);

/// Compares every verdict of lookups at each of the biases with the curve.
/// @param look_up  Looks up again at this constant bias.
/// @throws std::invalid_argument  if the images, or a lookup, differ in size.
[[nodiscard]] BiasVerification
verify_biases(const scene::Image<std::uint32_t>& triangles, const scene::Image<float>& criticals,
              std::span<const float> biases,
              const std::function<scene::LookupLayers(float constant)>& look_up);

} // namespace gnomon::analysis
