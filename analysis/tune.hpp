#pragma once

#include "analysis/bias_curve.hpp"
#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What the user asks of a shadow map: of amounts without what a kernel softens on purpose, and of
/// counts.
struct TuneLimits {
    double max_shadow_amount_rate = 0.001; ///< of the scored lit pixels
    double max_light_amount_rate = 0.005;  ///< of the scored blocked pixels
    double max_false_shadow_rate = 1;      ///< by count
    double max_false_lit_rate = 1;
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
    /// All biases with as few errors, within the limits where they can be met; where verdicts are
    /// fractions, as far as biases were tried.
    BiasInterval interval;
    ErrorCounts errors;                      ///< with `constant`: exact
    ErrorAmounts amounts;                    ///< the same
    double shadow_softening = 0;             ///< [px]
    double light_softening = 0;              ///< [px]
    std::optional<double> false_shadow_rate; ///< empty: no scored lit pixel
    std::optional<double> false_lit_rate;    ///< empty: no scored blocked pixel
    std::optional<double> error_rate;        ///< empty: no scored pixel
    /// Amounts without softening per lit, per blocked pixel; empty as the counts' are.
    std::optional<double> shadow_rate;
    std::optional<double> light_rate;
    bool meets_limits = false;

    /// By how much verdicts are wrong without what a kernel softens on purpose [px].
    [[nodiscard]] double error_amount() const
    {
        return amounts.total() - shadow_softening - light_softening;
    }
};

/// Whether a is to be recommended rather than b: it meets the limits, is less wrong by amount, has
/// fewer errors, a smaller map, or a wider interval of best biases. Of settings that meet the
/// limits only those of as many bytes are compared.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

struct TuneResult {
    std::vector<TunedSetting> considered; ///< in the order of their maps' bytes
    std::size_t recommended = 0;          ///< index; the one that is least wrong if none meets
    bool meets_limits = false;
    Comparison measured; ///< GL's own run with the recommended setting

    [[nodiscard]] const TunedSetting& best() const { return considered[recommended]; }
};

/// The job with a setting's keys in place of its own.
[[nodiscard]] scene::Job tuned_job(const scene::Job& job, const TunedSetting& setting);

/// Searches resolution, depth format, near and far, slope, normal offset and constant bias.
///
/// Maps are tried from the fewest bytes upwards, and the search ends with the first number of bytes
/// at which a setting meets the limits. Among those it is the one that is least wrong, then
/// the one with the widest interval of best biases, whose middle is recommended. Of filters whose
/// verdicts are no fractions constant biases are not sampled: the bias curve knows the errors of
/// every float32 in [0, 1]. Others are tried at logarithmically spaced biases, from their curve, or
/// by GL's own runs for `hardware`, which has none.
/// @param file      The scene; must outlive the result, which points to its triangles.
/// @param progress  told of each setting considered; may be empty.
/// @throws scene::InputError  as `compare` does, or if no resolution is left to try or no pixel is
///                            scored.
[[nodiscard]] TuneResult tune(const scene::Job& job, const scene::SceneFile& file,
                              const Renderers& renderers, const TuneLimits& limits,
                              const std::function<void(const TunedSetting&)>& progress);

} // namespace gnomon::analysis
