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

/// What GL's own lookups with other constant biases say of critical biases.
struct BiasVerification {
    /// One lookup, over all pixels that show a receiver.
    struct Rerun {
        float bias = 0; ///< depth units
        std::uint64_t lit = 0;
        std::uint64_t shadowed = 0;
        std::uint64_t differences = 0; ///< verdicts that are not those of the critical biases
    };
    std::vector<Rerun> reruns; ///< ascending biases

    [[nodiscard]] std::uint64_t verdicts() const;
    [[nodiscard]] std::uint64_t differences() const;
};

/// Adds lookups to what is known, if anything is.
void add_reruns(std::optional<BiasVerification>& known, BiasVerification more);

/// Constant biases that put critical biases to the test: those that matter anyway, and at, just
/// below and just above five critical biases, the smallest, the largest and three evenly spaced
/// between by rank.
/// @param criticals  `critical_biases`; infinite ones turn with no bias.
/// @param triangles  of the receivers; pixels without one do not count.
/// @param wanted     biases that are among the result.
/// @return  ascending, without repetitions.
[[nodiscard]] std::vector<float> biases_to_verify(const scene::Image<float>& criticals,
                                                  const scene::Image<std::uint32_t>& triangles,
                                                  std::span<const float> wanted);

/// Compares every verdict of a lookup with this constant bias with the pixel's critical bias, which
/// says: lit iff it is at most the bias.
/// @param criticals, triangles  as for `biases_to_verify`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] BiasVerification::Rerun hold_to_curve(const scene::LookupLayers& lookup,
                                                    const scene::Image<std::uint32_t>& triangles,
                                                    const scene::Image<float>& criticals,
                                                    float bias);

/// Holds every verdict of a lookup with each of the biases to the curve.
/// @param look_up  again, with this constant bias.
/// @throws std::invalid_argument  if the images, or a lookup, differ in size.
[[nodiscard]] BiasVerification
verify_biases(const scene::Image<std::uint32_t>& triangles, const scene::Image<float>& criticals,
              std::span<const float> biases,
              const std::function<scene::LookupLayers(float constant)>& look_up);

} // namespace gnomon::analysis
