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

/// Amounts of error at a bias, and the part of them that a kernel softens borders by.
struct SoftAmounts {
    ErrorAmounts amounts;
    Softening softening;
};

/// A curve of fractions, of one view or of several together, that is known where it is asked.
/// Biases ascend, and answers are in their order.
struct AskedCurve {
    /// Cheaper, for no causes are found.
    std::function<std::vector<ErrorAmounts>(std::span<const float>)> amounts;
    std::function<std::vector<SoftAmounts>(std::span<const float>)> measure;
};

/// How closely biases are tried.
enum class BiasSteps : std::uint8_t {
    fine,   ///< 64 of `fine_biases`, and 64 more wherever they do not reach far enough
    coarse, ///< the same of `coarse_biases`, 7 at once: where a setting is one of many
};

/// What was found where a curve was asked.
struct TriedMinimum {
    std::vector<ErrorPiece> pieces; ///< of the biases tried, ascending, without softening
    std::optional<BroadMinimum> broad_minimum; ///< empty: none is broad
};

/// Tries biases around the least error without softening, and finds their valley.
///
/// While the least error or an end of the valley lies at an edge of the biases that were tried,
/// more are tried beyond it, at most four times.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] TriedMinimum search_broad_minimum(const AskedCurve& curve, BiasSteps steps);

} // namespace gnomon::analysis
