#pragma once

#include "analysis/tune/tune.hpp"
#include "methods/polygon_offset.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A setting that a search tried, as text, job-file keys and graphics API states.
namespace gnomon::reports {

/// The search results for one light.
struct TunedLight {
    std::string light; ///< empty if the job has only one
    analysis::TuneResult result;
};

/// A setting's keys, ready to paste into a job file; for one of several lights, behind its
/// `[[lights]]`. Numbers read back to the same bits. After a search over methods, these are all
/// tables of the method, with comments that name the tables to remove.
/// @param own_fit  The fit of the job that the keys go into.
[[nodiscard]] std::string tune_toml(const analysis::TunedSetting& setting, scene::Fit own_fit,
                                    const std::string& light = {});

/// The recommended keys.
[[nodiscard]] std::string best_toml(const TunedLight& tuned);

/// The recommended keys that differ from the job's, one line per table.
[[nodiscard]] std::string changed_toml(const TunedLight& tuned);

/// A line of progress: "512 d16, fit scene, pcf3, slope 0.1, offset 1: 0.12 % and 0.40 %".
[[nodiscard]] std::string tuned_setting_line(const analysis::TunedSetting& setting);

[[nodiscard]] bool has_cascades(const analysis::TunedSetting& setting);
/// Whether the setting's method has this shared key. The job's own method has them all.
[[nodiscard]] bool has_key(const analysis::TunedSetting& setting, std::string_view key);
/// "512 d16"; "no map".
[[nodiscard]] std::string map_name(const analysis::TunedSetting& setting);
/// "scene"; "half_extent 3.2"; for cascades their count, fit and λ or split: "4 tight, 0.5".
[[nodiscard]] std::string shape_text(const analysis::TunedSetting& setting);
/// "–" if the method has no filter.
[[nodiscard]] std::string_view filter_text(const analysis::TunedSetting& setting);

/// The method keys and bias-term keys that a search over methods set.
[[nodiscard]] std::vector<std::pair<std::string, scene::JobValue>>
method_keys(const analysis::TunedSetting& setting);

/// The polygon offset that the job draws its maps with.
[[nodiscard]] std::optional<methods::PolygonOffset> map_offset(const analysis::TuneResult& result);

/// The job's lookup biases other than constant, slope and normal offset: "bias.slope_kernels = 1".
[[nodiscard]] std::vector<std::string> other_biases(const scene::Job& job);

/// The job's own setting, with its constant bias as the job writes it.
[[nodiscard]] analysis::TunedSetting own_setting(const scene::Job& job);

/// A setting in one graphics API.
struct ApiState {
    std::string api;                ///< "GL", "Direct3D", "Vulkan"
    std::vector<std::string> lines; ///< code, or why there is none
};

/// The states that draw and look up such a map: format, comparison, culling, polygon offset, and
/// the shader lines that apply the biases.
/// @param offset        of the job; a tuned setting has no polygon offset.
/// @param other_biases  of the job, as `other_biases` returns them.
[[nodiscard]] std::vector<ApiState>
api_states(const analysis::TunedSetting& setting,
           const std::optional<methods::PolygonOffset>& offset = {},
           std::span<const std::string> other_biases = {});

} // namespace gnomon::reports
