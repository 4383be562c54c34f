#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/metrics/amounts.hpp"
#include "analysis/renderers.hpp"
#include "scene/job/job.hpp"
#include "scene/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What GL's own run with a constant bias measured, for lookups that have no curve.
struct BiasRerun {
    float bias = 0; ///< depth units
    ErrorCounts errors;
    std::optional<double> false_shadow_rate; ///< empty: no scored lit pixel
    std::optional<double> false_lit_rate;    ///< empty: no scored blocked pixel
    std::optional<double> error_rate;        ///< empty: no scored pixel
    ErrorAmounts amounts;
};

/// The constant biases to run GL again with: 0, and four a decade from 1e-6 to 1.
[[nodiscard]] std::vector<float> rerun_list();

/// Looks the receivers up again with each constant bias of the `rerun_list`.
///
/// The map must be the one drawn last. Afterwards GL's last lookup is that of the largest bias.
/// @param view  the slope and normal offset of its bias are kept.
/// @return  in ascending order of the biases.
[[nodiscard]] std::vector<BiasRerun> rerun_biases(const scene::Job& job, const scene::View& view,
                                                  const scene::TruthLayers& truth,
                                                  const Renderers& renderers);

} // namespace gnomon::analysis
