#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_metrics.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What breaking a rule means.
enum class Severity : std::uint8_t { fail, warn };

/// Of which configurations a rule is, by what became of their job since the baseline.
enum class JobState : std::uint8_t {
    any,
    unchanged, ///< the same parameters, and the same renderer
    changed,
};

/// What a metric must keep to (docs/gate.md).
struct GateRule {
    std::string id;
    std::string metric; ///< `find_gate_metric` knows it; points of a curve by `name()`
    /// A configuration is meant if each of these settings has that value; numbers compare as such.
    std::map<std::string, std::string> where;
    PixelFilter pixels = {};  ///< of which pixels
    bool each_object = false; ///< of each object by itself
    bool each_band = false;   ///< of each band of light distance by itself
    JobState job = JobState::any;

    std::optional<double> max; ///< of the metric itself
    std::optional<double> min;

    /// The change for the worse may be as large as the largest of these; without any of them, it
    /// is not judged.
    std::optional<double> abs;          ///< in the metric's unit; >= 0
    std::optional<double> rel;          ///< times the baseline's value; >= 0
    std::optional<double> allow_pixels; ///< of a count; >= 0
    std::optional<double> allow_share;  ///< of a count, times the image's pixels; in [0, 1]
    /// More than that only warns up to this share of what the configuration's wrong pixels fell
    /// by: the price of others that became right. >= 0; of what is no count, infinite.
    std::optional<double> trade_off;

    Worse worse = Worse::up;
    Severity severity = Severity::fail;
    bool is_optional = false; ///< it may match nothing
    std::string place = {};   ///< "gate.toml:12"; empty for the default rules

    [[nodiscard]] bool judges_change() const { return abs || rel || allow_pixels || allow_share; }
};

/// Whether a rule is of this configuration.
/// @param now        As it is now.
/// @param unchanged  Whether its job and renderer are those of the baseline.
[[nodiscard]] bool is_meant(const GateRule& rule, const GateEntry& now, bool unchanged);

/// The rules that hold where there is no file: no count of wrong pixels, cause or label, none of an
/// object or a band of light distance, and no gap may grow, and no pixel may become wrong.
/// Everything is deterministic, so nothing at all is allowed while the job is unchanged; where it
/// changed, counts may grow by 1 in 100,000 of the image's pixels and gaps by 5 %, and pixels that
/// become wrong are a warning. So are, then, counts that grow by at most a tenth of what all wrong
/// pixels fell by, and causes and labels that grow while those do not: pixels that stay wrong have
/// another cause where the one before it is mended.
/// Amounts are held as the counts are, and while the job is unchanged the classes must stay. The
/// rules of `tested_rules` are among them.
[[nodiscard]] std::vector<GateRule> default_gate_rules();

/// That something is tested where the job changed: a run without scored pixels breaks no other
/// rule, nor does one that scores less than nine tenths of what the baseline does. They hold beside
/// a file's rules, too, but for one that says by itself how few `scored_pixels` fail.
[[nodiscard]] std::vector<GateRule> tested_rules();

/// The filters that a rule is judged by in one configuration: its own, or one for each object or
/// band that both know.
/// @param before  nullptr if the baseline lacks it.
/// @return  Empty if the rule is of each object or band and there is none that both know.
[[nodiscard]] std::vector<PixelFilter> filters_of(const GateRule& rule, const GateEntry* before,
                                                  const GateEntry& now);

} // namespace gnomon::analysis
