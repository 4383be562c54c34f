#include "analysis/sweep/plan.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

namespace {

using Kind = SweepStep::Kind;

/// Numbering texts by first appearance.
class Numbering {
public:
    std::size_t of(const std::string& text)
    {
        return numbers_.try_emplace(text, numbers_.size()).first->second;
    }

private:
    std::map<std::string, std::size_t> numbers_;
};

/// A curve's stages by number. Curves run in the order of the members.
struct CurveStages {
    std::size_t scene = 0;
    std::size_t light = 0;
    std::size_t group = 0; ///< of cameras held at once
    std::size_t frustum = 0;
    std::size_t texels = 0; ///< the map without its depth format, on which exact rays do not depend
    std::size_t map = 0;
    bool has_map = true;
    std::size_t filtered = 0;
    bool is_filtered = false; ///< whether the method prefilters the map
    std::size_t truth = 0;
    std::size_t receivers = 0;
    std::size_t lookup = 0;
    std::size_t curve = 0; ///< index of the request
    std::size_t slot = 0;

    [[nodiscard]] auto order() const
    {
        return std::tie(scene, light, group, frustum, texels, map, filtered, truth, lookup, curve);
    }
};

std::vector<CurveStages> ordered_curves(std::span<const CurveRequest> requests, std::size_t slots)
{
    Numbering scenes;
    Numbering lights;
    Numbering frusta;
    Numbering texels;
    Numbering maps;
    Numbering filtered;
    Numbering truths;
    Numbering receivers;
    Numbering lookups;
    std::map<std::string, Numbering> cameras_by_scene;
    std::vector<CurveStages> all;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const StageKeys& keys = requests[i].keys;
        const std::size_t camera = cameras_by_scene[keys.scene].of(keys.camera);
        all.push_back({scenes.of(keys.scene), lights.of(keys.light), camera / slots,
                       frusta.of(keys.frustum), texels.of(keys.texels), maps.of(keys.map),
                       !keys.map.empty(), filtered.of(keys.filtered), !keys.filtered.empty(),
                       truths.of(keys.truth), receivers.of(keys.receivers), lookups.of(keys.lookup),
                       i, camera % slots});
    }
    std::sort(all.begin(), all.end(),
              [](const CurveStages& a, const CurveStages& b) { return a.order() < b.order(); });
    return all;
}

/// The stages in memory, and the steps that computed them.
class PlanBuilder {
public:
    explicit PlanBuilder(std::size_t slots) : truth_(slots, nothing), receivers_(slots, nothing) {}

    void add_curve(const CurveStages& stages)
    {
        if (scene_ != stages.scene) {
            add(Kind::read_scene, stages);
            *this = PlanBuilder{std::move(steps_), truth_.size()};
            scene_ = stages.scene;
        }
        const bool needs_receivers = receivers_[stages.slot] != stages.receivers;
        if (needs_receivers) {
            add(Kind::draw_receivers, stages);
            receivers_[stages.slot] = stages.receivers;
        }
        if (truth_[stages.slot] != stages.truth) {
            add(Kind::find_truth, stages);
            truth_[stages.slot] = stages.truth;
        }
        const bool needs_map = stages.has_map && map_ != stages.map;
        if (needs_map) {
            add(Kind::draw_shadow_map, stages);
            map_ = stages.map;
            filtered_ = nothing;
        }
        const bool needs_filter = stages.is_filtered && filtered_ != stages.filtered;
        if (needs_filter) {
            add(Kind::prefilter, stages);
            filtered_ = stages.filtered;
        }
        if (lookup_ != stages.lookup || needs_map || needs_filter || needs_receivers) {
            add(Kind::look_up, stages);
            lookup_ = stages.lookup;
        }
        add(Kind::answer, stages);
    }

    std::vector<SweepStep> take() { return std::move(steps_); }

private:
    static constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

    PlanBuilder(std::vector<SweepStep> steps, std::size_t slots) : PlanBuilder{slots}
    {
        steps_ = std::move(steps);
    }
    void add(Kind kind, const CurveStages& stages)
    {
        steps_.push_back({kind, stages.curve, stages.slot});
    }

    std::vector<SweepStep> steps_;
    std::size_t scene_ = nothing;
    std::size_t map_ = nothing;
    std::size_t filtered_ = nothing;
    std::size_t lookup_ = nothing;
    std::vector<std::size_t> truth_;
    std::vector<std::size_t> receivers_;
};

// Bytes per pixel: receivers 40 and lookup 24 on the GPU; per camera 24 for truth, gaps and bins,
// 66 for exact rays through one map's texels, causes and gaps, and 32 for other maps' texels; two
// lookups in progress, each 24, with 60 for causes, distances and errors.
constexpr std::uint64_t camera_bytes = 40 + 24 + 66 + 32;
constexpr std::uint64_t lookup_bytes = 24 + 2 * 24 + 60;
/// For u-formats, or a GL format with its depths read back.
constexpr std::uint64_t peak_texel_bytes = 12;

/// Limit for cameras held at once with the largest map: a 1920×1080 image with an 8192² map has the
/// memory to itself.
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

SweepPlan make_plan(std::span<const CurveRequest> requests, std::size_t slots)
{
    if (slots == 0) {
        throw std::invalid_argument("make_plan: slots: must be at least 1");
    }
    PlanBuilder builder{slots};
    for (const CurveStages& stages : ordered_curves(requests, slots)) {
        builder.add_curve(stages);
    }
    return {builder.take(), slots};
}

PlanCounts SweepPlan::counts(std::span<const CurveRequest> requests) const
{
    std::array<std::uint64_t, 7> by_kind{};
    PlanCounts counts;
    for (const SweepStep& step : steps) {
        ++by_kind[static_cast<std::size_t>(step.kind)];
        if (step.kind == Kind::answer) {
            counts.configurations += requests[step.curve].ordinals.size();
        }
    }
    const auto of = [&](Kind kind) { return by_kind[static_cast<std::size_t>(kind)]; };
    counts.scenes = of(Kind::read_scene);
    counts.truths = of(Kind::find_truth);
    counts.receiver_passes = of(Kind::draw_receivers);
    counts.shadow_maps = of(Kind::draw_shadow_map);
    counts.prefilters = of(Kind::prefilter);
    counts.lookup_passes = of(Kind::look_up);
    counts.curves = of(Kind::answer);
    return counts;
}

bool SweepPlan::needs_map_after(std::size_t index) const
{
    for (const SweepStep& step : std::span{steps}.subspan(index + 1)) {
        if (step.kind == Kind::read_scene || step.kind == Kind::draw_shadow_map) {
            return false;
        }
        if (step.kind == Kind::prefilter || step.kind == Kind::look_up ||
            step.kind == Kind::answer) {
            return true;
        }
    }
    return false;
}

bool SweepPlan::needs_truth_after(std::size_t index) const
{
    for (const SweepStep& step : std::span{steps}.subspan(index + 1)) {
        if (step.kind == Kind::read_scene) {
            return false;
        }
        if (step.slot == steps[index].slot &&
            (step.kind == Kind::find_truth || step.kind == Kind::look_up ||
             step.kind == Kind::answer)) {
            return step.kind != Kind::find_truth;
        }
    }
    return false;
}

double estimate_seconds(const SweepStep& step, const CurveRequest& request)
{
    const auto pixels = static_cast<double>(request.pixels);
    const auto texels = static_cast<double>(request.texels);
    switch (step.kind) {
    case Kind::read_scene:
        return 0.5;
    case Kind::draw_receivers:
        return 0.01 + pixels * 30e-9;
    case Kind::find_truth:
        return pixels * 250e-9;
    case Kind::draw_shadow_map:
        return 0.005 + texels * 3e-9;
    case Kind::prefilter:
        return 0.005 + texels * 20e-9;
    case Kind::look_up:
        return pixels * 40e-9;
    case Kind::answer:
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

} // namespace gnomon::analysis
