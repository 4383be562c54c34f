#pragma once

#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_curves.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Divides the requests among shards of about equal estimated time. Neighbours in the plan, which
/// share stages, stay together.
/// @return  The shard of each request, from 1.
[[nodiscard]] std::vector<std::uint32_t>
divide(const SweepPlan& plan, std::span<const CurveRequest> requests, std::uint32_t shards);

/// A sweep's work in units, each for one process.
struct UnitDivision {
    std::vector<std::uint32_t> unit_of; ///< by request, from 1
    /// By unit, the estimated wall time [s] of its steps, with the stages that it repeats from
    /// other units (`estimate_seconds`).
    std::vector<double> seconds;
};

/// Divides the plan's bias curves among units of about equal time. A unit begins where the plan
/// changes scene, else truth or receivers, else map, if its time then stays within a third of its
/// share: there, units repeat least. One plan always gives the same units.
/// @param count  Number of units; >= 1. There are at most as many as curves.
/// @throws std::invalid_argument  if `count` is 0.
[[nodiscard]] UnitDivision
divide_into_units(const SweepPlan& plan, std::span<const CurveRequest> requests, std::size_t count);

/// The number of units of about a minute each; at least 1. Source: docs/scaling.md#units.
[[nodiscard]] std::size_t default_unit_count(const SweepPlan& plan,
                                             std::span<const CurveRequest> requests);

/// Moves requests that differ only in the path of one scene to the part of the first of them, which
/// computes them once.
/// @param scenes  By request; requests with unreadable scenes stay.
/// @param parts   By request.
void keep_equals_together(const SweepCurves& curves, std::span<const SceneIdentity> scenes,
                          std::span<std::uint32_t> parts);

/// The configurations of each unit, ascending; the first unit has the refused ones.
/// @param unit_of  By request, from 1 to `count`.
[[nodiscard]] std::vector<std::vector<std::uint64_t>>
ordinals_of_units(const SweepCurves& curves, std::span<const std::uint32_t> unit_of,
                  std::size_t count);

/// `count` ordinals: `first`, `first + step`, ….
struct OrdinalRun {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    std::uint64_t step = 1;

    friend bool operator==(const OrdinalRun&, const OrdinalRun&) = default;
};

/// Ascending ordinals as runs, each as long as possible.
[[nodiscard]] std::vector<OrdinalRun> ordinal_runs(std::span<const std::uint64_t> ordinals);
/// The ordinals of runs, in their order.
[[nodiscard]] std::vector<std::uint64_t> ordinals_of(std::span<const OrdinalRun> runs);

} // namespace gnomon::analysis
