#include "analysis/gate/baseline_update.hpp"

#include <algorithm>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

bool is_as_before(const GateEntry& before, const GateEntry& now)
{
    return before.parameters == now.parameters && before.metrics == now.metrics &&
           before.cells == now.cells && (now.pixels.empty() || before.pixels == now.pixels);
}

/// The run's entries, with the baseline's masks where the run kept no pixels of what is as before.
GateEntries with_known_pixels(const GateEntries& baseline, GateEntries run)
{
    if (!can_be_merged(baseline, run)) {
        return run;
    }
    for (GateEntry& now : run.entries) {
        const auto known = std::find_if(baseline.entries.begin(), baseline.entries.end(),
                                        [&](const GateEntry& one) { return one.key == now.key; });
        if (known != baseline.entries.end() && now.pixels.empty() && is_as_before(*known, now)) {
            now.pixels = known->pixels;
        }
    }
    return run;
}

} // namespace

bool can_be_merged(const GateEntries& baseline, const GateEntries& run)
{
    return baseline.axes == run.axes && is_same_renderer(baseline.environment, run.environment);
}

GateEntries updated_baseline(const GateEntries& baseline, const GateEntries& run,
                             BaselineUpdate update)
{
    if (update == BaselineUpdate::all) {
        return with_known_pixels(baseline, run);
    }
    if (!can_be_merged(baseline, run)) {
        throw std::invalid_argument(
            "updated_baseline: baseline and run: their axes or renderers differ");
    }
    GateEntries updated = baseline;
    updated.environment = run.environment;
    for (const GateEntry& now : run.entries) {
        const auto known = std::find_if(updated.entries.begin(), updated.entries.end(),
                                        [&](const GateEntry& one) { return one.key == now.key; });
        if (known == updated.entries.end()) {
            if (update == BaselineUpdate::missing) {
                updated.entries.push_back(now);
            }
        } else if (update == BaselineUpdate::changed && !is_as_before(*known, now)) {
            *known = now;
        }
    }
    (void)sort_entries(updated);
    return updated;
}

} // namespace gnomon::analysis
