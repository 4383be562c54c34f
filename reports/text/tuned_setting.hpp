#pragma once

#include "analysis/tune/tune.hpp"
#include "methods/polygon_offset.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What is said of a setting that a search has tried.
namespace gnomon::reports {

/// What was tuned.
struct TunedLight {
    std::string light; ///< name of the one of several; empty: the job has but one
    analysis::TuneResult result;
};

/// The keys of a setting, ready to paste into a job file; of one of several lights, behind its
/// `[[lights]]`. Numbers read back to the same bits. Of a search over methods it is all of the
/// method's tables, with the names of those that must go.
/// @param own_fit  that of the job which it is pasted into.
[[nodiscard]] std::string tune_toml(const analysis::TunedSetting& setting, scene::Fit own_fit,
                                    const std::string& light = {});

/// The recommended keys.
[[nodiscard]] std::string best_toml(const TunedLight& tuned);

/// Those of the recommended keys that are not as the job has them: each table in a line.
[[nodiscard]] std::string changed_toml(const TunedLight& tuned);

/// "512 d16, fit scene, pcf3, slope 0.1, offset 1: 0.12 % and 0.40 %": a line of progress.
[[nodiscard]] std::string tuned_setting_line(const analysis::TunedSetting& setting);

[[nodiscard]] bool has_cascades(const analysis::TunedSetting& setting);
/// Whether the setting's method has a key that methods share: the job's own has them all.
[[nodiscard]] bool has_key(const analysis::TunedSetting& setting, std::string_view key);
/// "512 d16"; "no map".
[[nodiscard]] std::string map_name(const analysis::TunedSetting& setting);
/// "scene"; "±3.2 m" of a map about what is in shadow; of cascades "4 tight, 0.5", their number,
/// fit and λ, or their split.
[[nodiscard]] std::string shape_text(const analysis::TunedSetting& setting);
/// "–" where the method has no filter.
[[nodiscard]] std::string_view filter_text(const analysis::TunedSetting& setting);

/// What a search over methods chose of a method's keys, and what it set of those of its bias terms.
[[nodiscard]] std::vector<std::pair<std::string, scene::JobValue>>
method_keys(const analysis::TunedSetting& setting);

/// What the job draws its maps with, of the setting that is recommended.
[[nodiscard]] std::optional<methods::PolygonOffset> map_offset(const analysis::TuneResult& result);

/// The biases of the lookup that it has from the job beside constant, slope and normal offset:
/// "bias.slope_kernels = 1".
[[nodiscard]] std::vector<std::string> other_biases(const analysis::TuneResult& result);

} // namespace gnomon::reports
