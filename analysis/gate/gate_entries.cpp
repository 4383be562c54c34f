#include "analysis/gate/gate_entries.hpp"

#include "analysis/causes/cause.hpp"
#include "analysis/gate/gate_metrics.hpp"
#include "methods/key_table.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

/// Negative, 0 or positive if a sorts before, with or after b.
int compared_values(const std::string& a, const std::string& b)
{
    const std::optional<double> a_number = number_in(a);
    const std::optional<double> b_number = number_in(b);
    if (a_number && b_number && *a_number != *b_number) {
        return *a_number < *b_number ? -1 : 1;
    }
    if (a_number.has_value() != b_number.has_value()) {
        return a_number ? -1 : 1;
    }
    return a.compare(b);
}

/// The value that a job without the key has, such as one older than the key; empty without a
/// default.
std::optional<std::string> default_of(const std::string& key)
{
    const scene::Key* const spec = methods::key_table()->find(key);
    if (spec == nullptr || spec->default_text.empty()) {
        return std::nullopt;
    }
    const std::string& text = spec->default_text;
    const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    return is_quoted ? text.substr(1, text.size() - 2) : text;
}

bool is_as_before(const GateEntry& before, const GateEntry& now)
{
    return before.parameters == now.parameters && before.metrics == now.metrics &&
           before.cells == now.cells && (now.pixels.empty() || before.pixels == now.pixels);
}

/// The run's entries; unchanged ones without pixels take the baseline's masks.
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

bool operator<(const ConfigurationKey& a, const ConfigurationKey& b)
{
    if (a.case_name != b.case_name) {
        return a.case_name < b.case_name;
    }
    return std::lexicographical_compare(a.axes.begin(), a.axes.end(), b.axes.begin(), b.axes.end(),
                                        [](const auto& one, const auto& other) {
                                            return one.first != other.first
                                                       ? one.first < other.first
                                                       : compared_values(one.second, other.second) <
                                                             0;
                                        });
}

std::optional<double> GateEntry::metric(const std::string& name) const
{
    if (const auto found = metrics.find(name); found != metrics.end()) {
        return found->second;
    }
    struct Sum {
        std::string_view name;
        const char* one;
        const char* other;
    };
    for (const Sum& sum : {Sum{wrong_pixels_metric, "false_shadow", "false_lit"},
                           Sum{error_amount_metric, "shadow_amount", "light_amount"},
                           Sum{scored_pixels_metric, "pixels.lit", "pixels.blocked"}}) {
        if (name == sum.name && metrics.contains(sum.one) && metrics.contains(sum.other)) {
            return metrics.at(sum.one) + metrics.at(sum.other);
        }
    }
    const auto gap_pixels = metrics.find(std::string{gap_pixels_metric});
    const bool has_no_gap = gap_pixels != metrics.end() && gap_pixels->second == 0;
    return is_gap_length(name) && has_no_gap ? std::optional{0.0} : std::nullopt;
}

std::optional<double> GateEntry::metric(const std::string& name, const PixelFilter& filter) const
{
    if (filter.takes_all()) {
        return metric(name);
    }
    return is_of_pixels(name) ? metric_of_pixels(cells, name, filter) : std::nullopt;
}

std::optional<std::string_view> GateEntry::setting(const std::string& name) const
{
    if (name == "case") {
        return key.case_name;
    }
    for (const auto* settings : {&key.axes, &parameters}) {
        if (const auto found = settings->find(name); found != settings->end()) {
            return found->second;
        }
    }
    return std::nullopt;
}

std::optional<std::pair<std::size_t, std::size_t>> sort_entries(GateEntries& run)
{
    std::sort(run.axes.begin(), run.axes.end());
    auto& entries = run.entries;
    std::stable_sort(entries.begin(), entries.end(),
                     [](const GateEntry& a, const GateEntry& b) { return a.key < b.key; });
    const auto equal =
        std::adjacent_find(entries.begin(), entries.end(),
                           [](const GateEntry& a, const GateEntry& b) { return a.key == b.key; });
    if (equal == entries.end()) {
        return std::nullopt;
    }
    const auto index = static_cast<std::size_t>(equal - entries.begin());
    return std::pair{index, index + 1};
}

bool is_same_renderer(const Environment& a, const Environment& b)
{
    return a.gl_renderer == b.gl_renderer && a.gl_version == b.gl_version && a.embree == b.embree;
}

std::vector<ParameterChange> changed_parameters(const GateEntry& before, const GateEntry& now)
{
    const auto value = [](const GateEntry& entry, const std::string& key) {
        const auto found = entry.parameters.find(key);
        return found == entry.parameters.end() ? default_of(key) : std::optional{found->second};
    };
    const auto hash = value(now, "scene_hash");
    const bool is_same_scene = hash && hash == value(before, "scene_hash");
    std::set<std::string> keys;
    for (const GateEntry* entry : {&before, &now}) {
        for (const auto& [key, text] : entry->parameters) {
            keys.insert(key);
        }
    }
    std::vector<ParameterChange> changes;
    for (const std::string& key : keys) {
        ParameterChange change{key, value(before, key), value(now, key)};
        if (change.before != change.now && !(is_same_scene && key == "scene.file")) {
            changes.push_back(std::move(change));
        }
    }
    return changes;
}

std::optional<DominantCause> dominant_cause(const GateEntry& before, const GateEntry& now,
                                            const PixelFilter& filter)
{
    std::optional<DominantCause> dominant;
    for (std::size_t i = 1; i < cause_names.size(); ++i) { // the first is "none"
        const auto rise_of = [&](std::string_view kind) {
            const std::string metric = fmt::format("{}.{}", kind, cause_names[i]);
            const auto was = before.metric(metric, filter);
            const auto is = now.metric(metric, filter);
            return was && is ? std::optional{*is - *was} : std::nullopt;
        };
        const auto by_amount = rise_of("cause_amounts");
        const double rise = by_amount ? *by_amount : rise_of("causes").value_or(0);
        if (rise > (dominant ? dominant->pixels : 0)) {
            dominant = DominantCause{std::string{cause_names[i]}, rise};
        }
    }
    return dominant;
}

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
            "updated_baseline: baseline and run differ in axes or renderer");
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
