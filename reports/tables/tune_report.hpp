#pragma once

#include "analysis/tune/tune.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::reports {

/// What was tuned.
struct TunedLight {
    std::string light; ///< name of the one of several; empty: the job has but one
    analysis::TuneResult result;
};

/// The keys of a setting, ready to paste into a job file; of one of several lights, behind its
/// `[[lights]]`. Numbers read back to the same bits.
/// @param own_fit  that of the job which it is pasted into.
[[nodiscard]] std::string tune_toml(const analysis::TunedSetting& setting, scene::Fit own_fit,
                                    const std::string& light = {});

/// How much a tune tells.
enum class TuneDetail : std::uint8_t {
    answer, ///< the recommended keys alone
    found,  ///< the best of each map, what was measured and why
    tried,  ///< every setting
};

/// What was considered, the recommendation as TOML and as states of graphics interfaces, what was
/// measured with it in each view, and why; of several lights one after the other.
[[nodiscard]] std::string tune_text(std::span<const TunedLight> lights,
                                    const analysis::TuneLimits& limits, TuneDetail detail);

/// The same as one JSON object; docs/tune.md names its members.
[[nodiscard]] std::string tune_json(std::span<const TunedLight> lights,
                                    const analysis::TuneLimits& limits);

/// "512 d16, fit scene, pcf3, slope 0.1, offset 1: 0.12 % and 0.40 %": a line of progress.
[[nodiscard]] std::string tuned_setting_line(const analysis::TunedSetting& setting);

} // namespace gnomon::reports
