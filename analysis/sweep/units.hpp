#pragma once

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/scene_identity.hpp"
#include "analysis/sweep/sweep_curves.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// A sweep's work in units, each of which one process computes by itself.
struct UnitDivision {
    std::vector<std::uint32_t> unit_of; ///< by request, from 1
    /// By unit, the estimated wall time [s] of its steps and of the stages that it has to repeat
    /// because another unit has them, too (`estimate_seconds`).
    std::vector<double> seconds;
};

/// Divides the plan's bias curves among units of about equal time. A unit begins where the plan
/// changes scene, else truth or receivers, else map, as far as that keeps its time within a third
/// of its share: what units have to repeat is least there. The same plan gives the same units.
/// @param count  of units; >= 1. There are no more than curves.
/// @throws std::invalid_argument  if `count` is 0.
[[nodiscard]] UnitDivision
divide_into_units(const SweepPlan& plan, std::span<const CurveRequest> requests, std::size_t count);

/// How many units of about a minute the plan is; at least 1. Source: docs/scaling.md#units.
[[nodiscard]] std::size_t default_unit_count(const SweepPlan& plan,
                                             std::span<const CurveRequest> requests);

/// Moves requests that differ in nothing but the place of the same scene to the part of the first
/// of them, where they are computed once.
/// @param scenes  by request; those that cannot be read stay where they are.
/// @param parts   by request.
void keep_equals_together(const SweepCurves& curves, std::span<const SceneIdentity> scenes,
                          std::span<std::uint32_t> parts);

/// The requests' configurations of each unit, ascending; refused ones are the first unit's.
/// @param unit_of  by request, from 1 to `count`.
[[nodiscard]] std::vector<std::vector<std::uint64_t>>
ordinals_of_units(const SweepCurves& curves, std::span<const std::uint32_t> unit_of,
                  std::size_t count);

/// Ordinals `first`, `first + step`, …, so many.
struct OrdinalRun {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    std::uint64_t step = 1;

    friend bool operator==(const OrdinalRun&, const OrdinalRun&) = default;
};

/// Ascending ordinals as runs, from the first on each as long as it goes.
[[nodiscard]] std::vector<OrdinalRun> ordinal_runs(std::span<const std::uint64_t> ordinals);
/// The ordinals of runs, in their order.
[[nodiscard]] std::vector<std::uint64_t> ordinals_of(std::span<const OrdinalRun> runs);

} // namespace gnomon::analysis
