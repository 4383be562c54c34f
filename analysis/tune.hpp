#pragma once

#include "analysis/bias_curve.hpp"
#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What the user asks of a shadow map.
struct TuneLimits {
    double max_false_shadow_rate = 0.001; ///< of the scored lit pixels
    double max_false_lit_rate = 0.005;    ///< of the scored blocked pixels
    int max_resolution_texels = 4096;
};

/// Memory that a map takes [bytes]; u-formats as if GL had them.
[[nodiscard]] std::uint64_t map_bytes(const scene::ShadowMapSettings& map);

/// One setting that was considered, with the best constant bias for it.
struct TunedSetting {
    scene::ShadowMapSettings map;
    double slope = 0;
    double normal_texels = 0;
    float constant = 0; ///< nearest the middle of `interval`
    BiasInterval
        interval;       ///< all biases with as few errors, within the limits where they can be met
    ErrorCounts errors; ///< with any of them: exact
    std::optional<double> false_shadow_rate; ///< empty: no scored lit pixel
    std::optional<double> false_lit_rate;    ///< empty: no scored blocked pixel
    std::optional<double> error_rate;        ///< empty: no scored pixel
    bool meets_limits = false;
};

/// Whether a is to be recommended rather than b: it meets the limits, has fewer errors, a smaller
/// map, or a wider interval of best biases. Of settings that meet the limits only those of as many
/// bytes are compared.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

struct TuneResult {
    std::vector<TunedSetting> considered; ///< in the order of their maps' bytes
    std::size_t recommended = 0; ///< index; the one with the lowest error rate if none meets
    bool meets_limits = false;
    Comparison measured; ///< GL's own run with the recommended setting

    [[nodiscard]] const TunedSetting& best() const { return considered[recommended]; }
};

/// The job with a setting's keys in place of its own.
[[nodiscard]] scene::Job tuned_job(const scene::Job& job, const TunedSetting& setting);

/// Searches resolution, depth format, near and far, slope, normal offset and constant bias.
///
/// Maps are tried from the fewest bytes upwards, and the search ends with the first number of bytes
/// at which a setting meets the limits. Among those it is the one with the lowest error rate, then
/// the one with the widest interval of best biases, whose middle is recommended. Constant biases
/// are not sampled: the bias curve knows the errors of every float32 in [0, 1]. For `hardware`,
/// which has none, GL is run again at logarithmically spaced biases.
/// @param file      The scene; must outlive the result, which points to its triangles.
/// @param progress  told of each setting considered; may be empty.
/// @throws scene::InputError  as `compare` does, or if no resolution is left to try or no pixel is
///                            scored.
[[nodiscard]] TuneResult tune(const scene::Job& job, const scene::SceneFile& file,
                              const Renderers& renderers, const TuneLimits& limits,
                              const std::function<void(const TunedSetting&)>& progress);

} // namespace gnomon::analysis
