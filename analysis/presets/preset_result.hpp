#pragma once

#include "analysis/metrics/map_results.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/job/value.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

struct Comparison;

/// A job's biases at its median receiver, in the first of its maps.
struct ReceiverBias {
    double light_distance_m = 0; ///< median light distance of the scored receivers [m]
    double texel_m = 0;          ///< width of a texel there
    MapBias bias;
    double slope = 0;         ///< depth units per unit of tan θ
    double normal_texels = 0; ///< widths of a texel
    double constant_r = 0;    ///< the constant bias in smallest steps of the format at that depth
};

/// The job's other bias terms at the median receiver: those outside the bias curve's formula, but
/// for the normal offset in texels.
struct FurtherBias {
    std::map<std::string, scene::JobValue> keys; ///< that are not at their defaults
    double constant = 0; ///< texels and the polygon offset's units together [depth units]
    double constant_m = 0;
    double constant_texels = 0;
    double constant_r = 0;
    /// The polygon offset's factor, per unit of tan θ, for a surface that slopes along a row or
    /// column of texels [m]; down to 1/√2 of it if it slopes across both.
    double slope_m = 0;
};

/// @param light_distance_m  of the receivers; > 0 for a spot.
[[nodiscard]] ReceiverBias bias_at(const scene::Job& job, const scene::View& view,
                                   double light_distance_m);

/// Those terms at a receiver; empty if the job sets none of them. A reversed map's polygon offset
/// counts as that of the unreversed map.
/// @param light_distance_m  of the receivers; > 0 for a spot.
/// @param unit  Of the polygon offset there [depth units]; empty: a step of the format.
/// Source: OpenGL 4.6 §14.6.5.
[[nodiscard]] std::optional<FurtherBias> further_bias_at(const scene::Job& job,
                                                         const scene::View& view,
                                                         double light_distance_m,
                                                         std::optional<double> unit = {});

/// The result of a preset, or of the job itself.
struct PresetResult {
    const scene::Preset* preset = nullptr; ///< nullptr: the job as it is
    scene::Job job;
    std::optional<ReceiverBias> receiver; ///< empty: no pixel is scored, or the light has no map
    std::optional<FurtherBias> further;   ///< empty: as `receiver`, or the job has no such bias
    Metrics metrics;
    Gaps peter_panning;
    std::uint64_t map_bytes = 0;
};

[[nodiscard]] PresetResult preset_result(const Comparison& comparison, const scene::Preset* preset);

/// A preset that does not fit the job.
struct SkippedPreset {
    const scene::Preset* preset = nullptr;
    std::string why;
};

/// The presets side by side.
struct PresetComparison {
    std::string scene;
    scene::LightType light = scene::LightType::directional;
    PresetResult job; ///< as it is
    std::vector<PresetResult> results;
    std::vector<SkippedPreset> skipped;
};

} // namespace gnomon::analysis
