#pragma once

#include "analysis/environment.hpp"
#include "analysis/gate/gate_filter.hpp"
#include "analysis/metrics/error_buckets.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Identifies a configuration among those of its run, and in another run: the values of the sweep's
/// axes, but no fixed parameter.
struct ConfigurationKey {
    std::string case_name;                   ///< empty without cases
    std::map<std::string, std::string> axes; ///< job keys and their values as text

    friend bool operator==(const ConfigurationKey&, const ConfigurationKey&) = default;
};

/// Orders by case, then axis by axis; numbers by value.
[[nodiscard]] bool operator<(const ConfigurationKey& a, const ConfigurationKey& b);

/// A configuration as the gate sees it.
struct GateEntry {
    ConfigurationKey key;
    /// The resolved job without the axes, as text, and `scene_hash`; without keys that have no
    /// value.
    std::map<std::string, std::string> parameters;
    /// By the names in docs/gate.md; without metrics that have no value.
    std::map<std::string, double> metrics;
    std::vector<ErrorBucket> cells = {}; ///< by object and light distance; empty: unknown
    /// Where to find its wrong pixels: in a baseline the name of the mask, in a run the
    /// configuration's id; empty if they were not kept.
    std::string pixels = {};

    /// A metric's value; empty if unknown. A gap's length is 0 if the causes are known and no pixel
    /// has a gap.
    [[nodiscard]] std::optional<double> metric(const std::string& name) const;
    /// A metric's value over the pixels that the filter takes; also empty if the metric is not one
    /// of pixels.
    [[nodiscard]] std::optional<double> metric(const std::string& name,
                                               const PixelFilter& filter) const;
    /// The value of a parameter, an axis, or `case`; empty if it has none.
    [[nodiscard]] std::optional<std::string_view> setting(const std::string& name) const;
};

/// The results of a run, or those that a baseline kept.
struct GateEntries {
    Environment environment;
    std::vector<std::string> axes;  ///< sorted
    std::vector<GateEntry> entries; ///< sorted by key, each key once
};

/// Sorts axes and entries.
/// @return  Indices of two sorted entries with one key; empty if all keys differ.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> sort_entries(GateEntries& run);

/// Whether GL renderer, GL version and Embree are equal. Gnomon's version does not count: a gate
/// checks that its results stay.
[[nodiscard]] bool is_same_renderer(const Environment& a, const Environment& b);

/// A parameter that changed.
struct ParameterChange {
    std::string key;
    std::optional<std::string> before; ///< empty: it had no value
    std::optional<std::string> now;

    friend bool operator==(const ParameterChange&, const ParameterChange&) = default;
};

/// The parameters whose values differ, by key. The path of the scene's file does not count if the
/// scene is known to be unchanged.
[[nodiscard]] std::vector<ParameterChange> changed_parameters(const GateEntry& before,
                                                              const GateEntry& now);

/// The cause whose error grew most.
struct DominantCause {
    std::string name;  ///< "bias"
    double pixels = 0; ///< growth, by amount if both have amounts; > 0

    friend bool operator==(const DominantCause&, const DominantCause&) = default;
};

/// @param filter  The pixels that count.
/// @return  Empty if no cause grew, or causes are unknown.
[[nodiscard]] std::optional<DominantCause>
dominant_cause(const GateEntry& before, const GateEntry& now, const PixelFilter& filter = {});

/// Which entries of a baseline an update replaces.
enum class BaselineUpdate : std::uint8_t {
    missing, ///< adds the configurations that it lacks
    changed, ///< replaces those that changed
    all,     ///< takes the run's entries, and drops all others
};

/// The baseline after an update.
/// @param run  `GateEntry::pixels` are names of masks. An entry without pixels keeps the baseline's
///             mask if everything else, renderer included, is unchanged.
/// @throws std::invalid_argument  if axes or renderers differ, unless everything is replaced.
[[nodiscard]] GateEntries updated_baseline(const GateEntries& baseline, const GateEntries& run,
                                           BaselineUpdate update);

/// Whether axes and renderers are equal, so that one baseline may hold entries of both.
[[nodiscard]] bool can_be_merged(const GateEntries& baseline, const GateEntries& run);

} // namespace gnomon::analysis
