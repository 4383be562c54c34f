#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "scene/image.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Wrong pixels of cause `precision`, by what of it is to blame (docs/causes.md).
struct PrecisionKinds {
    std::uint64_t format = 0;    ///< right with the same map of 32-bit floats
    std::uint64_t transform = 0; ///< by float32 matrices and interpolated positions
};

/// The wrong pixels of cause `precision`: row-major indices, ascending.
[[nodiscard]] std::vector<std::size_t> wrong_by_precision(const scene::Image<Cause>& causes,
                                                          const scene::Truth& truth,
                                                          const scene::LookupLayers& lookup);

/// Counts them by whether the same map drawn as d32f repairs them, compared as V1 does, with V2's
/// bias.
/// @param floats  of that map: its `job` has the job's tan θ, its `unbiased` and `map_depths` are
///                the float map's (`linear`: without `map_depths`).
/// @param pixels  from `wrong_by_precision`.
/// @param bias    the job's.
[[nodiscard]] PrecisionKinds find_precision_kinds(const CauseInputs& floats,
                                                  std::span<const std::size_t> pixels,
                                                  const scene::Bias& bias);

/// The same of a method that compares no depths.
/// @param biased, unbiased  its verdicts in that map, at the receivers themselves.
[[nodiscard]] PrecisionKinds find_precision_kinds(const scene::Truth& truth,
                                                  const scene::LookupLayers& biased,
                                                  const scene::LookupLayers& unbiased,
                                                  std::span<const std::size_t> pixels);

} // namespace gnomon::analysis
