#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_metrics.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The consequence of breaking a rule.
enum class Severity : std::uint8_t { fail, warn };

/// The configurations that a rule covers, by whether their job changed since the baseline.
enum class JobState : std::uint8_t {
    any,
    unchanged, ///< equal parameters and renderer
    changed,
};

/// A limit on a metric (docs/gate.md).
struct GateRule {
    std::string id;
    std::string metric; ///< `find_gate_metric` knows it; points of a curve by `name()`
    /// A configuration matches if each of these settings has that value; numbers compare as
    /// numbers.
    std::map<std::string, std::string> where;
    PixelFilter pixels = {};  ///< the pixels that count
    bool each_object = false; ///< judges each object by itself
    bool each_band = false;   ///< judges each band of light distance by itself
    JobState job = JobState::any;

    std::optional<double> max; ///< of the metric itself
    std::optional<double> min;

    /// The largest of these bounds the change for the worse; without any of them, the change is not
    /// judged.
    std::optional<double> abs;          ///< in the metric's unit; >= 0
    std::optional<double> rel;          ///< times the baseline's value; >= 0
    std::optional<double> allow_pixels; ///< of a count; >= 0
    std::optional<double> allow_share;  ///< of a count, times the image's pixels; in [0, 1]
    /// A larger change only warns up to this share of the fall in the configuration's wrong pixels:
    /// the price of others that became right. >= 0; infinite for metrics that are not counts.
    std::optional<double> trade_off;

    Worse worse = Worse::up;
    Severity severity = Severity::fail;
    bool is_optional = false; ///< it may match nothing
    std::string place = {};   ///< "gate.toml:12"; empty for the default rules

    [[nodiscard]] bool judges_change() const { return abs || rel || allow_pixels || allow_share; }
};

/// Whether a rule covers this configuration.
/// @param now        The configuration in the run.
/// @param unchanged  Its job and renderer are those of the baseline.
[[nodiscard]] bool is_meant(const GateRule& rule, const GateEntry& now, bool unchanged);

/// The rules without a rule file: no count of wrong pixels, cause or label may grow, in the image,
/// an object or a band of light distance; no gap may grow, and no pixel may become wrong. All
/// results are deterministic, so an unchanged job allows no growth at all. For a changed job,
/// counts may grow by 1 in 100,000 of the image's pixels and gaps by 5 %; pixels that become wrong
/// are warnings. So are counts that grow by at most a tenth of the fall in all wrong pixels, and
/// causes and labels that grow without more wrong pixels: a pixel that stays wrong has another
/// cause once the first is fixed. Amounts follow the rules of counts. An unchanged job must keep
/// its pixel classes. Includes `tested_rules`.
[[nodiscard]] std::vector<GateRule> default_gate_rules();

/// Rules that a changed job still tests something: a run without scored pixels, or with less than
/// nine tenths of the baseline's, breaks no other rule. They also hold with a rule file, unless it
/// limits `scored_pixels` itself.
[[nodiscard]] std::vector<GateRule> tested_rules();

/// The filters by which a rule judges one configuration: its own, or one for each object or band in
/// both runs.
/// @param before  nullptr if the baseline lacks it.
/// @return  Empty if the rule judges each object or band, and the runs share none.
[[nodiscard]] std::vector<PixelFilter> filters_of(const GateRule& rule, const GateEntry* before,
                                                  const GateEntry& now);

} // namespace gnomon::analysis
