#include "analysis/sweep/cost.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

using StepKind = SweepStep::Kind;

// Bytes a pixel: receivers 40 and lookup 24 on the GPU; for each camera its truth, gaps and bins
// 24, what exact rays say of one map's texels, causes and gaps 66, and what is remembered of other
// maps' texels 32; two lookups under way, each 24, with causes, distances and errors 60.
constexpr std::uint64_t camera_bytes = 40 + 24 + 66 + 32;
constexpr std::uint64_t lookup_bytes = 24 + 2 * 24 + 60;
constexpr std::uint64_t peak_texel_bytes =
    12; ///< u-formats, or a GL format and its depths read back

/// What cameras that are kept side by side may take, with the largest map: an image of 1920×1080
/// beside one of 8192² has the memory for itself.
constexpr std::uint64_t most_bytes = std::uint64_t{5} << 28U;
constexpr std::size_t most_slots = 8;

std::uint64_t estimate_bytes(std::size_t slots, std::span<const CurveRequest> requests)
{
    std::uint64_t pixels = 1;
    std::uint64_t texels = 0;
    for (const CurveRequest& request : requests) {
        pixels = std::max(pixels, request.pixels);
        texels = std::max(texels, request.texels);
    }
    return pixels * (slots * camera_bytes + lookup_bytes) + texels * peak_texel_bytes;
}

} // namespace

double estimate_seconds(const SweepStep& step, const CurveRequest& request)
{
    const auto pixels = static_cast<double>(request.pixels);
    const auto texels = static_cast<double>(request.texels);
    switch (step.kind) {
    case StepKind::read_scene:
        return 0.5;
    case StepKind::draw_receivers:
        return 0.01 + pixels * 30e-9;
    case StepKind::find_truth:
        return pixels * 250e-9;
    case StepKind::draw_shadow_map:
        return 0.005 + texels * 3e-9;
    case StepKind::prefilter:
        return 0.005 + texels * 20e-9;
    case StepKind::look_up:
        return pixels * 40e-9;
    case StepKind::answer:
        if (request.asks_gl) { // one bisection, some 90 lookups with their errors, and the rows'
            return pixels * (350e-9 + (90 + static_cast<double>(request.ordinals.size())) * 50e-9);
        }
        return pixels * 400e-9 + static_cast<double>(request.ordinals.size()) * 30e-6;
    }
    return 0;
}

double estimate_seconds(const SweepPlan& plan, std::span<const CurveRequest> requests)
{
    double seconds = 0;
    for (const SweepStep& step : plan.steps) {
        seconds += estimate_seconds(step, requests[step.curve]);
    }
    return seconds;
}

std::uint64_t estimate_bytes(const SweepPlan& plan, std::span<const CurveRequest> requests)
{
    return estimate_bytes(plan.slots, requests);
}

std::size_t camera_slots(std::span<const CurveRequest> requests)
{
    std::size_t slots = most_slots;
    while (slots > 1 && estimate_bytes(slots, requests) > most_bytes) {
        --slots;
    }
    return slots;
}

std::vector<std::uint32_t> divide(const SweepPlan& plan, std::span<const CurveRequest> requests,
                                  std::uint32_t shards)
{
    const double whole = estimate_seconds(plan, requests);
    std::vector<std::uint32_t> shard_of(requests.size(), 1);
    double before = 0;
    double pending = 0; // of the steps that lead to the next answer
    for (const SweepStep& step : plan.steps) {
        pending += estimate_seconds(step, requests[step.curve]);
        if (step.kind == StepKind::answer) {
            const double middle = before + pending / 2;
            const double part = std::floor(middle / whole * shards);
            shard_of[step.curve] = 1 + std::min(shards - 1, static_cast<std::uint32_t>(part));
            before += pending;
            pending = 0;
        }
    }
    return shard_of;
}

} // namespace gnomon::analysis
