#pragma once

#include "analysis/environment.hpp"
#include "analysis/gate/gate_filter.hpp"
#include "analysis/metrics/error_buckets.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// What tells a configuration from the others of its run, and finds it in another run: the values
/// of the sweep's axes, never the parameters that are fixed.
struct ConfigurationKey {
    std::string case_name;                   ///< empty without cases
    std::map<std::string, std::string> axes; ///< job keys and their values as text

    friend bool operator==(const ConfigurationKey&, const ConfigurationKey&) = default;
};

/// Orders by case, then axis by axis; numbers by their value.
[[nodiscard]] bool operator<(const ConfigurationKey& a, const ConfigurationKey& b);

/// What the gate knows of a configuration.
struct GateEntry {
    ConfigurationKey key;
    /// The resolved job without the axes, as text, and `scene_hash`; keys without a value are
    /// left out.
    std::map<std::string, std::string> parameters;
    /// By their names in docs/gate.md; what does not exist is left out.
    std::map<std::string, double> metrics;
    std::vector<ErrorBucket> cells = {}; ///< by object and light distance; empty: not known
    /// What finds its wrong pixels: of a baseline the name of the mask, of a run the
    /// configuration's id; empty: they were not kept.
    std::string pixels = {};

    /// A metric's value, empty if it is not known; the length of a gap is 0 where the causes are
    /// known and no pixel has a gap.
    [[nodiscard]] std::optional<double> metric(const std::string& name) const;
    /// The same of the pixels that the filter takes; empty too for a metric that is not of pixels.
    [[nodiscard]] std::optional<double> metric(const std::string& name,
                                               const PixelFilter& filter) const;
    /// The value of a parameter, of an axis, or of `case`; empty if it has none.
    [[nodiscard]] std::optional<std::string_view> setting(const std::string& name) const;
};

/// The results of a run, or what a baseline kept of them.
struct GateEntries {
    Environment environment;
    std::vector<std::string> axes;  ///< sorted
    std::vector<GateEntry> entries; ///< sorted by key, each key once
};

/// Sorts the entries.
/// @return  Two entries with the same key, as indices into the sorted ones; empty if there are
///          none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> sort_entries(GateEntries& run);

/// Whether both come from the same GL renderer, GL version and Embree. The version of Gnomon does
/// not matter: that its results stay is what a gate is for.
[[nodiscard]] bool is_same_renderer(const Environment& a, const Environment& b);

/// A parameter that is not what it was.
struct ParameterChange {
    std::string key;
    std::optional<std::string> before; ///< empty: it had no value
    std::optional<std::string> now;

    friend bool operator==(const ParameterChange&, const ParameterChange&) = default;
};

/// The parameters whose values differ, by key. The path of a scene's file counts only where the
/// scene is not known to be the same.
[[nodiscard]] std::vector<ParameterChange> changed_parameters(const GateEntry& before,
                                                              const GateEntry& now);

/// The cause of which there is more error than before, most of all.
struct DominantCause {
    std::string name;  ///< "bias"
    double pixels = 0; ///< more than before, by amount where both have amounts; > 0

    friend bool operator==(const DominantCause&, const DominantCause&) = default;
};

/// @param filter  Of which pixels.
/// @return  Empty if no cause has more error than before, or causes are not known.
[[nodiscard]] std::optional<DominantCause>
dominant_cause(const GateEntry& before, const GateEntry& now, const PixelFilter& filter = {});

} // namespace gnomon::analysis
