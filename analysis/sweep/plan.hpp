#pragma once

#include "analysis/sweep/stage_keys.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Configurations on one bias curve: they differ only in the constant bias.
struct CurveRequest {
    StageKeys keys;
    std::vector<std::uint64_t> ordinals; ///< of the configurations, ascending
    std::uint64_t pixels = 0;            ///< of the image
    std::uint64_t texels = 0;            ///< of the map
    bool asks_gl = false;                ///< for each requested bias
};

/// One piece of a sweep's work. It names a curve, whose job has the settings.
struct SweepStep {
    enum class Kind : std::uint8_t {
        read_scene,      ///< drops all earlier stages
        draw_receivers,  ///< GL, into a slot
        find_truth,      ///< for the receivers in a slot
        draw_shadow_map, ///< GL; becomes the current map
        prefilter,       ///< GL: the method's prefiltering of the current map
        look_up,         ///< GL: looks up the receivers of a slot in the map
        answer,          ///< the curve, and the configurations on it
    };
    Kind kind = Kind::read_scene;
    std::size_t curve = 0; ///< index into the requests
    std::size_t slot = 0;  ///< which of the cameras held at once

    friend bool operator==(const SweepStep&, const SweepStep&) = default;
};

/// How often each stage runs.
struct PlanCounts {
    std::uint64_t configurations = 0;
    std::uint64_t scenes = 0;
    std::uint64_t truths = 0;
    std::uint64_t receiver_passes = 0;
    std::uint64_t shadow_maps = 0;
    std::uint64_t prefilters = 0; ///< of maps that a method prefilters
    std::uint64_t lookup_passes = 0;
    std::uint64_t curves = 0;

    friend bool operator==(const PlanCounts&, const PlanCounts&) = default;
};

/// A sweep's work, in order. A stage whose keys did not change since it last ran has no step.
struct SweepPlan {
    std::vector<SweepStep> steps;
    std::size_t slots = 1; ///< cameras held at once

    [[nodiscard]] PlanCounts counts(std::span<const CurveRequest> requests) const;
    /// Whether a later step needs the map that exists after step `index`.
    [[nodiscard]] bool needs_map_after(std::size_t index) const;
    /// Whether a later step needs the truth that the step's slot then holds.
    [[nodiscard]] bool needs_truth_after(std::size_t index) const;
};

/// Orders the work so that scenes, lights and cameras change least, then the light's matrix, then
/// the map: one truth per scene, camera and light; one receiver pass per camera and everything else
/// that receivers depend on; one shadow map per map setting and `slots` cameras.
/// @param slots  Cameras whose receivers and truth fit in memory together; >= 1.
/// @throws std::invalid_argument  if `slots` is 0.
[[nodiscard]] SweepPlan make_plan(std::span<const CurveRequest> requests, std::size_t slots);

/// Rough wall time of a step [s], on two cores with software GL. It divides work among shards, and
/// warns of hours before the start. Source: docs/performance.md#estimate.
[[nodiscard]] double estimate_seconds(const SweepStep& step, const CurveRequest& request);
[[nodiscard]] double estimate_seconds(const SweepPlan& plan,
                                      std::span<const CurveRequest> requests);

/// Memory of the plan, without the scene and its hierarchy [bytes].
[[nodiscard]] std::uint64_t estimate_bytes(const SweepPlan& plan,
                                           std::span<const CurveRequest> requests);

/// How many cameras may be held at once for images of this size; at least 1.
[[nodiscard]] std::size_t camera_slots(std::span<const CurveRequest> requests);

} // namespace gnomon::analysis
