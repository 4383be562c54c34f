#include "analysis/sweep/units.hpp"

#include "scene/fnv1a.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace gnomon::analysis {

namespace {

using Kind = SweepStep::Kind;
constexpr std::size_t step_kinds = static_cast<std::size_t>(Kind::answer) + 1;

/// Target time of a unit [s]: long beside the second that a process takes to start, and short
/// enough to repeat a lost unit.
constexpr double unit_seconds = 60;

/// How far, as a share of its time, a unit may end from it for a better place.
constexpr double tolerance = 1.0 / 3;

constexpr auto stages_before_answer =
    std::to_array<Kind>({Kind::read_scene, Kind::draw_receivers, Kind::find_truth,
                         Kind::draw_shadow_map, Kind::prefilter, Kind::look_up});
static_assert(stages_before_answer.size() + 1 == step_kinds);

/// A curve in the plan's order, with the steps before its answer.
struct PlacedCurve {
    std::size_t curve = 0;
    double lead_seconds = 0; ///< of the steps before its answer
    double seconds = 0;      ///< of all its own steps
    /// Extra time as the first of a unit [s]: for stages shared with earlier curves.
    double repeated_seconds = 0;
};

/// Time to repeat stages if a unit begins with these steps [s].
double repeated_seconds(const std::array<bool, step_kinds>& has, std::size_t curve,
                        const CurveRequest& request)
{
    double seconds = 0;
    for (const Kind kind : stages_before_answer) {
        const bool is_asked = (kind != Kind::draw_shadow_map || !request.keys.map.empty()) &&
                              (kind != Kind::prefilter || !request.keys.filtered.empty());
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
        if (step.kind != Kind::answer) {
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

/// The index after the last curve of the unit that begins at `begin`. Steps before its first answer
/// do not count towards the share: every unit must do them, whether or not others did.
/// @param share     Its time without those steps [s].
/// @param most_end  The last index that leaves a curve for each later unit.
std::size_t end_of_unit(std::span<const PlacedCurve> curves, std::size_t begin, double share,
                        std::size_t most_end)
{
    double seconds = curves[begin].seconds - curves[begin].lead_seconds;
    std::size_t best = begin + 1;
    double best_repeated = 0;
    double best_distance = -1; // of the time from its share; negative: none found yet
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

std::vector<std::uint32_t> divide(const SweepPlan& plan, std::span<const CurveRequest> requests,
                                  std::uint32_t shards)
{
    const double whole = estimate_seconds(plan, requests);
    std::vector<std::uint32_t> shard_of(requests.size(), 1);
    double before = 0;
    double pending = 0; // of the steps that lead to the next answer
    for (const SweepStep& step : plan.steps) {
        pending += estimate_seconds(step, requests[step.curve]);
        if (step.kind == Kind::answer) {
            const double middle = before + pending / 2;
            const double part = std::floor(middle / whole * shards);
            shard_of[step.curve] = 1 + std::min(shards - 1, static_cast<std::uint32_t>(part));
            before += pending;
            pending = 0;
        }
    }
    return shard_of;
}

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
    // If two curves have equal hashes, one moves needlessly, which does no harm.
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
