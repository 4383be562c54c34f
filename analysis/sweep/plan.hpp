#pragma once

#include "analysis/sweep/stage_keys.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Configurations that one bias curve answers: they differ in the constant bias alone.
struct CurveRequest {
    StageKeys keys;
    std::vector<std::uint64_t> ordinals; ///< of the configurations, ascending
    std::uint64_t pixels = 0;            ///< of the image
    std::uint64_t texels = 0;            ///< of the map
    bool asks_gl = false;                ///< of every bias it is asked about
};

/// One piece of a sweep's work. Each names a curve, whose job says with what settings.
struct SweepStep {
    enum class Kind : std::uint8_t {
        read_scene,      ///< forgets everything else
        draw_receivers,  ///< GL, into a slot
        find_truth,      ///< of the receivers in a slot
        draw_shadow_map, ///< GL; the map drawn last is the one looked up
        prefilter,       ///< GL: what a method makes of the map drawn last
        look_up,         ///< GL: the receivers of a slot in the map
        answer,          ///< the curve, and the configurations on it
    };
    Kind kind = Kind::read_scene;
    std::size_t curve = 0; ///< index into the requests
    std::size_t slot = 0;  ///< which of the cameras that are kept side by side

    friend bool operator==(const SweepStep&, const SweepStep&) = default;
};

/// How often each stage runs.
struct PlanCounts {
    std::uint64_t configurations = 0;
    std::uint64_t scenes = 0;
    std::uint64_t truths = 0;
    std::uint64_t receiver_passes = 0;
    std::uint64_t shadow_maps = 0;
    std::uint64_t prefilters = 0; ///< of maps of which a method makes something
    std::uint64_t lookup_passes = 0;
    std::uint64_t curves = 0;

    friend bool operator==(const PlanCounts&, const PlanCounts&) = default;
};

/// A sweep's work in the order in which it is done. A stage whose keys did not change since it last
/// ran is not among the steps.
struct SweepPlan {
    std::vector<SweepStep> steps;
    std::size_t slots = 1; ///< cameras kept side by side

    [[nodiscard]] PlanCounts counts(std::span<const CurveRequest> requests) const;
    /// Whether a later step asks for the map that is there after step `index`.
    [[nodiscard]] bool needs_map_after(std::size_t index) const;
    /// Whether a later step asks for the truth that the step's slot has then.
    [[nodiscard]] bool needs_truth_after(std::size_t index) const;
};

/// Orders the work so that scenes, lights and cameras change least, then the light's matrix, then
/// the map: one truth per scene, camera and light; one receiver pass per camera and what receivers
/// depend on; one shadow map per map setting, as long as no more than `slots` cameras share it
/// (else one per `slots` of them).
/// @param slots  cameras whose receivers and truth fit in memory together; >= 1.
/// @throws std::invalid_argument  if `slots` is 0.
[[nodiscard]] SweepPlan make_plan(std::span<const CurveRequest> requests, std::size_t slots);

} // namespace gnomon::analysis
