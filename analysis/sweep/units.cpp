#include "analysis/sweep/units.hpp"

#include "analysis/sweep/cost.hpp"
#include "scene/fnv1a.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace gnomon::analysis {

namespace {

using StepOf = SweepStep::Kind;
constexpr std::size_t step_kinds = static_cast<std::size_t>(StepOf::answer) + 1;

/// Time that a unit should take [s]: what every process needs to start, a second or less, is little
/// beside it, and a unit that is lost is soon repeated.
constexpr double unit_seconds = 60;

/// How far from its share of the time a unit may end for the sake of a better place.
constexpr double tolerance = 1.0 / 3;

constexpr auto stages_before_answer =
    std::to_array<StepOf>({StepOf::read_scene, StepOf::draw_receivers, StepOf::find_truth,
                           StepOf::draw_shadow_map, StepOf::prefilter, StepOf::look_up});
static_assert(stages_before_answer.size() + 1 == step_kinds);

/// A curve in the plan's order, with the steps that lead to it.
struct PlacedCurve {
    std::size_t curve = 0;
    double lead_seconds = 0; ///< of the steps before its answer
    double seconds = 0;      ///< of all its own steps
    /// What it costs more as the first of a unit [s]: the stages that it shares with those before.
    double repeated_seconds = 0;
};

/// What a unit that begins with these steps has to do over again.
double repeated_seconds(const std::array<bool, step_kinds>& has, std::size_t curve,
                        const CurveRequest& request)
{
    double seconds = 0;
    for (const StepOf kind : stages_before_answer) {
        const bool is_asked = (kind != StepOf::draw_shadow_map || !request.keys.map.empty()) &&
                              (kind != StepOf::prefilter || !request.keys.filtered.empty());
        if (is_asked && !has[static_cast<std::size_t>(kind)]) {
            seconds += estimate_seconds({kind, curve, 0}, request);
        }
    }
    return seconds;
}

std::vector<PlacedCurve> placed_curves(const SweepPlan& plan,
                                       std::span<const CurveRequest> requests)
{
    std::vector<PlacedCurve> curves;
    std::array<bool, step_kinds> has{};
    double lead_seconds = 0;
    for (const SweepStep& step : plan.steps) {
        const double seconds = estimate_seconds(step, requests[step.curve]);
        if (step.kind != StepOf::answer) {
            has[static_cast<std::size_t>(step.kind)] = true;
            lead_seconds += seconds;
            continue;
        }
        curves.push_back({step.curve, lead_seconds, lead_seconds + seconds,
                          repeated_seconds(has, step.curve, requests[step.curve])});
        has = {};
        lead_seconds = 0;
    }
    return curves;
}

/// Where the next unit ends, given where it begins: the index after its last curve. What leads to
/// its first curve every unit has to do, whether others have done it or not: it is no part of the
/// share.
/// @param share     its time without that [s].
/// @param most_end  the last index that leaves a curve for every unit after it.
std::size_t end_of_unit(std::span<const PlacedCurve> curves, std::size_t begin, double share,
                        std::size_t most_end)
{
    double seconds = curves[begin].seconds - curves[begin].lead_seconds;
    std::size_t best = begin + 1;
    double best_repeated = 0;
    double best_distance = -1; // of the time to its share; negative: nothing was found yet
    for (std::size_t end = begin + 1; end <= most_end; ++end) {
        const double distance = std::abs(seconds - share);
        const double repeated = end < curves.size() ? curves[end].repeated_seconds : 0;
        const bool is_near = distance <= tolerance * share;
        const bool was_near = best_distance >= 0 && best_distance <= tolerance * share;
        const bool is_better = is_near && was_near
                                   ? repeated < best_repeated ||
                                         (repeated == best_repeated && distance < best_distance)
                                   : best_distance < 0 || distance < best_distance;
        if (is_better) {
            best = end;
            best_repeated = repeated;
            best_distance = distance;
        }
        if (end == curves.size() || seconds > (1 + tolerance) * share) {
            break;
        }
        seconds += curves[end].seconds;
    }
    return best;
}

} // namespace

UnitDivision divide_into_units(const SweepPlan& plan, std::span<const CurveRequest> requests,
                               std::size_t count)
{
    if (count == 0) {
        throw std::invalid_argument("divide_into_units: count: must be at least 1");
    }
    const std::vector<PlacedCurve> curves = placed_curves(plan, requests);
    double left = 0;
    for (const PlacedCurve& placed : curves) {
        left += placed.seconds;
    }
    UnitDivision division;
    division.unit_of.assign(requests.size(), 1);
    const std::size_t units = std::min(count, curves.size());
    std::size_t begin = 0;
    for (std::size_t unit = 0; unit < units; ++unit) {
        const std::size_t after = units - unit - 1;
        const std::size_t end =
            after == 0
                ? curves.size()
                : end_of_unit(curves, begin,
                              (left - curves[begin].lead_seconds) / static_cast<double>(after + 1),
                              curves.size() - after);
        double seconds = curves[begin].repeated_seconds;
        for (std::size_t i = begin; i < end; ++i) {
            seconds += curves[i].seconds;
            left -= curves[i].seconds;
            division.unit_of[curves[i].curve] = static_cast<std::uint32_t>(unit + 1);
        }
        division.seconds.push_back(seconds);
        begin = end;
    }
    return division;
}

std::size_t default_unit_count(const SweepPlan& plan, std::span<const CurveRequest> requests)
{
    const double units = std::ceil(estimate_seconds(plan, requests) / unit_seconds);
    return std::max<std::size_t>(1, static_cast<std::size_t>(units));
}

void keep_equals_together(const SweepCurves& curves, std::span<const SceneIdentity> scenes,
                          std::span<std::uint32_t> parts)
{
    // Hashes: of two curves of equal hash one moves where it need not, which does no harm.
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!scenes[i].hash.empty()) {
            scene::Fnv1a key;
            key.add(curves.curve_key(i, scenes[i]));
            parts[i] = known.try_emplace(key.value(), parts[i]).first->second;
        }
    }
}

std::vector<std::vector<std::uint64_t>> ordinals_of_units(const SweepCurves& curves,
                                                          std::span<const std::uint32_t> unit_of,
                                                          std::size_t count)
{
    std::vector<std::vector<std::uint64_t>> units(count);
    const auto add = [](std::vector<std::uint64_t>& unit, const std::vector<std::uint64_t>& more) {
        unit.insert(unit.end(), more.begin(), more.end());
    };
    for (std::size_t i = 0; i < unit_of.size(); ++i) {
        add(units.at(unit_of[i] - 1), curves.requests()[i].ordinals);
    }
    for (const Refusal& refusal : curves.refusals()) {
        add(units.at(0), refusal.ordinals);
    }
    for (std::vector<std::uint64_t>& unit : units) {
        std::sort(unit.begin(), unit.end());
    }
    return units;
}

std::vector<OrdinalRun> ordinal_runs(std::span<const std::uint64_t> ordinals)
{
    std::vector<OrdinalRun> runs;
    for (const std::uint64_t ordinal : ordinals) {
        if (!runs.empty()) {
            OrdinalRun& last = runs.back();
            if (last.count == 1) {
                last.step = ordinal - last.first;
            }
            if (ordinal == last.first + last.count * last.step) {
                ++last.count;
                continue;
            }
        }
        runs.push_back({ordinal, 1, 1});
    }
    return runs;
}

std::vector<std::uint64_t> ordinals_of(std::span<const OrdinalRun> runs)
{
    std::vector<std::uint64_t> ordinals;
    for (const OrdinalRun& run : runs) {
        for (std::uint64_t i = 0; i < run.count; ++i) {
            ordinals.push_back(run.first + i * run.step);
        }
    }
    return ordinals;
}

} // namespace gnomon::analysis
