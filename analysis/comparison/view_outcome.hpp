#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/softening.hpp"
#include "scene/infinity.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// The errors with some setting in one view.
struct ViewOutcome {
    float constant = 0; ///< the constant bias in this view, depth units
    Metrics metrics;
    double shadow_softening = 0; ///< intended softening of lit pixels [px]
    double light_softening = 0;  ///< intended softening of blocked pixels [px]
    /// The most softening that is no error: the softening at a constant bias of 0 [px].
    Softening most_left_out = {scene::infinity, scene::infinity};

    /// The part of the softening that is no error [px].
    [[nodiscard]] Softening left_out() const
    {
        return analysis::left_out({shadow_softening, light_softening}, most_left_out);
    }
    /// The amount of error without that part [px].
    [[nodiscard]] double error_amount() const
    {
        return metrics.amounts.total() - left_out().total();
    }
    /// `error_amount` / scored pixels; empty without scored pixels.
    [[nodiscard]] std::optional<double> error_rate() const;
    /// The amount of false shadow, without softening, per lit pixel; empty without lit pixels.
    [[nodiscard]] std::optional<double> shadow_rate() const;
    /// The amount of false light, without softening, per blocked pixel; empty without blocked
    /// pixels.
    [[nodiscard]] std::optional<double> light_rate() const;
};

/// Combines several views: adds up counts, amounts and softening; rates are those of the sums. The
/// constant bias is that of the first view.
/// @param outcomes  At least one.
[[nodiscard]] ViewOutcome pooled(std::span<const ViewOutcome> outcomes);

/// Index of the view with the largest error rate; on a tie, the first. A view without scored pixels
/// counts as 0.
/// @param outcomes  At least one.
[[nodiscard]] std::size_t worst_view(std::span<const ViewOutcome> outcomes);

} // namespace gnomon::analysis
