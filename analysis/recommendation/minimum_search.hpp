#pragma once

#include "analysis/lookup/amounts.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/recommendation/broad_minimum.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The biases to sample first if each costs a lookup: 0, and four for each decade from 1e-6 to 1.
/// Ascending.
[[nodiscard]] std::vector<float> coarse_biases();

/// The biases to sample on curves of fractions: 0, 256 from 1e-7 to 1, 6.5 % apart, and the coarse
/// ones. Ascending.
[[nodiscard]] std::vector<float> fine_biases();

/// Amounts of error at a bias, and the part of them that is intended softening.
struct SoftAmounts {
    ErrorAmounts amounts;
    Softening softening;
};

/// A curve of fractions, of one view or of several together, that must be sampled. Biases ascend,
/// and results are in their order.
struct SampledCurve {
    /// Cheaper than `measure`, since it finds no causes.
    std::function<std::vector<ErrorAmounts>(std::span<const float>)> amounts;
    std::function<std::vector<SoftAmounts>(std::span<const float>)> measure;
};

/// How densely to sample biases.
enum class BiasSteps : std::uint8_t {
    fine,   ///< 64 of `fine_biases`, then 64 more at a time beyond the window's ends
    coarse, ///< 7 of `coarse_biases` at a time; for one setting among many
};

/// The samples of a curve, and their broad minimum.
struct SampledMinimum {
    std::vector<ErrorPiece> pieces;            ///< the sampled biases, ascending, without softening
    std::optional<BroadMinimum> broad_minimum; ///< empty if none is broad
};

/// Samples biases around the least error without softening, and finds the broad minimum.
///
/// While the least error or an end of the broad minimum lies at an edge of the window, extends the
/// window beyond it, at most four times.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] SampledMinimum search_broad_minimum(const SampledCurve& curve, BiasSteps steps);

} // namespace gnomon::analysis
