#include "analysis/sweep/plan.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

namespace gnomon::analysis {

namespace {

using Kind = SweepStep::Kind;

/// Numbers texts in the order in which they come first.
class Numbers {
public:
    std::size_t of(const std::string& text)
    {
        return numbers_.try_emplace(text, numbers_.size()).first->second;
    }

private:
    std::map<std::string, std::size_t> numbers_;
};

/// A curve's stages by number; in the order of the members the curves are run.
struct Place {
    std::size_t scene = 0;
    std::size_t light = 0;
    std::size_t group = 0; ///< of cameras that are kept side by side
    std::size_t frustum = 0;
    std::size_t texels = 0; ///< the map but for its depth format: what exact rays see is kept
    std::size_t map = 0;
    bool has_map = true;
    std::size_t filtered = 0;
    bool is_filtered = false; ///< whether anything is made of the map
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

std::vector<Place> places(std::span<const CurveRequest> requests, std::size_t slots)
{
    Numbers scenes;
    Numbers lights;
    Numbers frusta;
    Numbers texels;
    Numbers maps;
    Numbers filtered;
    Numbers truths;
    Numbers receivers;
    Numbers lookups;
    std::map<std::string, Numbers> cameras_by_scene;
    std::vector<Place> all;
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
              [](const Place& a, const Place& b) { return a.order() < b.order(); });
    return all;
}

/// What is in memory, and the steps that brought it there.
class Steps {
public:
    explicit Steps(std::size_t slots) : truth_(slots, nothing), receivers_(slots, nothing) {}

    void reach(const Place& place)
    {
        if (scene_ != place.scene) {
            add(Kind::read_scene, place);
            *this = Steps{std::move(steps_), truth_.size()};
            scene_ = place.scene;
        }
        const bool needs_receivers = receivers_[place.slot] != place.receivers;
        if (needs_receivers) {
            add(Kind::draw_receivers, place);
            receivers_[place.slot] = place.receivers;
        }
        if (truth_[place.slot] != place.truth) {
            add(Kind::find_truth, place);
            truth_[place.slot] = place.truth;
        }
        const bool needs_map = place.has_map && map_ != place.map;
        if (needs_map) {
            add(Kind::draw_shadow_map, place);
            map_ = place.map;
            filtered_ = nothing;
        }
        const bool needs_filter = place.is_filtered && filtered_ != place.filtered;
        if (needs_filter) {
            add(Kind::prefilter, place);
            filtered_ = place.filtered;
        }
        if (lookup_ != place.lookup || needs_map || needs_filter || needs_receivers) {
            add(Kind::look_up, place);
            lookup_ = place.lookup;
        }
        add(Kind::answer, place);
    }

    std::vector<SweepStep> take() { return std::move(steps_); }

private:
    static constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

    Steps(std::vector<SweepStep> steps, std::size_t slots) : Steps{slots}
    {
        steps_ = std::move(steps);
    }
    void add(Kind kind, const Place& place) { steps_.push_back({kind, place.curve, place.slot}); }

    std::vector<SweepStep> steps_;
    std::size_t scene_ = nothing;
    std::size_t map_ = nothing;
    std::size_t filtered_ = nothing;
    std::size_t lookup_ = nothing;
    std::vector<std::size_t> truth_;
    std::vector<std::size_t> receivers_;
};

} // namespace

SweepPlan make_plan(std::span<const CurveRequest> requests, std::size_t slots)
{
    if (slots == 0) {
        throw std::invalid_argument("make_plan: slots: must be at least 1");
    }
    Steps steps{slots};
    for (const Place& place : places(requests, slots)) {
        steps.reach(place);
    }
    return {steps.take(), slots};
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

} // namespace gnomon::analysis
