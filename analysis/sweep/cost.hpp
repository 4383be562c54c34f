#pragma once

#include "analysis/sweep/plan.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Rough wall time of a step [s], on two cores with software GL: for dividing work among shards
/// and for telling hours from seconds before a start. Source: docs/performance.md#estimate.
[[nodiscard]] double estimate_seconds(const SweepStep& step, const CurveRequest& request);
[[nodiscard]] double estimate_seconds(const SweepPlan& plan,
                                      std::span<const CurveRequest> requests);

/// Memory that the plan needs beside the scene and its hierarchy [bytes].
[[nodiscard]] std::uint64_t estimate_bytes(const SweepPlan& plan,
                                           std::span<const CurveRequest> requests);

/// How many cameras may be kept side by side for images of this size; at least 1.
[[nodiscard]] std::size_t camera_slots(std::span<const CurveRequest> requests);

/// Divides the requests among shards: neighbours in the plan, which share stages, stay together,
/// and every shard gets about the same estimated time.
/// @return  for each request its shard, from 1.
[[nodiscard]] std::vector<std::uint32_t>
divide(const SweepPlan& plan, std::span<const CurveRequest> requests, std::uint32_t shards);

} // namespace gnomon::analysis
