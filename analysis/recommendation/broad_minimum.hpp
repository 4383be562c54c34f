#pragma once

#include "analysis/bias/bias_curve.hpp"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Biases from `lo` to `hi` that all have the same error; or one bias that was tried, lo = hi.
struct ErrorPiece {
    float lo = 0;
    float hi = 0;     ///< infinite where nothing limits the bias from above
    double error = 0; ///< [px]

    friend bool operator==(const ErrorPiece&, const ErrorPiece&) = default;
};

/// The pieces of biases >= 0, exactly, of lookups with one comparison a pixel.
/// @param lit, blocked  Critical biases of the scored pixels, ascending; of several views: all of
///                      them together.
/// @return  Ascending, without gaps: the first begins at 0, the last is infinite.
[[nodiscard]] std::vector<ErrorPiece> error_pieces(std::span<const float> lit,
                                                   std::span<const float> blocked);

/// The lowest broad run of biases that are nearly as good as the best.
struct BroadMinimum {
    BiasInterval run;
    double least = 0; ///< the smallest error of all pieces [px]
    double level = 0; ///< up to which the run's errors go [px]
};

/// Finds the valley of which a bias is recommended.
///
/// With m the least error, t is the least level >= m + √m at which some run of pieces with
/// error <= t is broad: it holds 0, or hi >= 1.5·lo. Of the runs at t it is the lowest that is
/// broad. √m is what the count of m rare pixels varies by from one view to another.
/// @param pieces  Ascending; no bias is negative, no error is.
/// @return  Empty if there are no pieces, or even all together are not broad.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] std::optional<BroadMinimum> find_broad_minimum(std::span<const ErrorPiece> pieces);

/// The recommended bias if it is allowed, else the nearest bias of the valley's run that is, else
/// the least of all that are; empty if none is.
/// @param recommended  In the run.
/// @param allowed      Ascending, disjoint.
[[nodiscard]] std::optional<float> allowed_bias(const BiasInterval& run, float recommended,
                                                std::span<const BiasInterval> allowed);

} // namespace gnomon::analysis
