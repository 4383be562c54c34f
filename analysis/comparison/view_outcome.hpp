#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/softening.hpp"
#include "scene/infinity.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// What a setting gives in one view.
struct ViewOutcome {
    float constant = 0; ///< the constant bias there, depth units
    Metrics metrics;
    double shadow_softening = 0; ///< what a kernel softens on purpose, of lit pixels [px]
    double light_softening = 0;  ///< of blocked pixels [px]
    /// The most of both that is left out of the error: what is softened with a constant bias of 0
    /// [px].
    Softening most_left_out = {scene::infinity, scene::infinity};

    /// What of the softening is left out of the error [px].
    [[nodiscard]] Softening left_out() const
    {
        return analysis::left_out({shadow_softening, light_softening}, most_left_out);
    }
    /// By how much verdicts are wrong without that [px].
    [[nodiscard]] double error_amount() const
    {
        return metrics.amounts.total() - left_out().total();
    }
    /// The same over the scored pixels; empty without any.
    [[nodiscard]] std::optional<double> error_rate() const;
    /// The amount of false shadow, without softening, per lit pixel; empty without any.
    [[nodiscard]] std::optional<double> shadow_rate() const;
    /// The amount of false light, without softening, per blocked pixel; empty without any.
    [[nodiscard]] std::optional<double> light_rate() const;
};

/// Several views as one: counts, amounts and softening are added up, rates are those of the sums.
/// The constant bias is the first one's.
/// @param outcomes  At least one.
[[nodiscard]] ViewOutcome pooled(std::span<const ViewOutcome> outcomes);

/// Index of the view with the largest error rate, of several the first; a view without scored
/// pixels counts as 0.
/// @param outcomes  At least one.
[[nodiscard]] std::size_t worst_view(std::span<const ViewOutcome> outcomes);

} // namespace gnomon::analysis
