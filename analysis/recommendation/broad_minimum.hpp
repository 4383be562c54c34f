#pragma once

#include "analysis/bias/bias_curve.hpp"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Biases from `lo` to `hi` with equal error, or a single sampled bias, lo = hi.
struct ErrorPiece {
    float lo = 0;
    float hi = 0;     ///< infinite if nothing limits the bias from above
    double error = 0; ///< [px]

    friend bool operator==(const ErrorPiece&, const ErrorPiece&) = default;
};

/// The exact pieces of all biases >= 0, for lookups with one comparison for each pixel.
/// @param lit, blocked  Critical biases of the scored pixels, ascending; of several views, merged.
/// @return  Ascending, without gaps: the first begins at 0, the last is infinite.
[[nodiscard]] std::vector<ErrorPiece> error_pieces(std::span<const float> lit,
                                                   std::span<const float> blocked);

/// The lowest broad run of biases that are nearly as good as the best.
struct BroadMinimum {
    BiasInterval run;
    double least = 0; ///< the smallest error of all pieces [px]
    double level = 0; ///< upper bound of the run's errors [px]
};

/// Finds the broad minimum from which a bias is recommended.
///
/// With m the least error, t is the least level >= m + √m at which some run of pieces with error <=
/// t is broad: it contains 0, or hi >= 1.5·lo. Returns the lowest broad run at level t. A count of
/// m rare pixels varies by √m between views.
/// @param pieces  Ascending; biases and errors are not negative.
/// @return  Empty if there are no pieces, or if even all of them together are not broad.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] std::optional<BroadMinimum> find_broad_minimum(std::span<const ErrorPiece> pieces);

/// The recommended bias if it is allowed, else the nearest allowed bias of the run, else the
/// smallest allowed bias; empty if no bias is allowed.
/// @param recommended  In the run.
/// @param allowed      Ascending, disjoint.
[[nodiscard]] std::optional<float> allowed_bias(const BiasInterval& run, float recommended,
                                                std::span<const BiasInterval> allowed);

} // namespace gnomon::analysis
