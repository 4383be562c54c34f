#pragma once

#include "measurements.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::benchmarks {

/// A quantity that a cost may be proportional to.
enum class Term : std::uint8_t {
    once,
    triangles,
    pixels,
    texels,
    pixels_log_triangles,    ///< rays through a hierarchy: pixels · log2(triangles)
    triangles_log_triangles, ///< building a hierarchy
    biases,                  ///< of one curve
    rows,                    ///< biases of all curves
    curves,
    cached_database, ///< bytes of the database in SQLite's cache
};

[[nodiscard]] std::string_view name_of(Term term);
[[nodiscard]] double value_of(Term term, const SweepSize& size);

/// A quantity, its terms by theory, and the series in which they vary.
struct CostDescription {
    std::string_view quantity;
    std::vector<Term> terms;
    std::vector<std::string_view> series;
};
[[nodiscard]] std::span<const CostDescription> cost_descriptions();

/// Whether the measurement is of the quantity and in one of its series.
[[nodiscard]] bool is_of(const CostDescription& cost, const Measurement& measurement);

struct FittedTerm {
    Term term;
    double coefficient; ///< [s] or [bytes] for one of the term
};
struct FittedCost {
    const CostDescription* description;
    std::vector<FittedTerm> terms;
};

/// Finds the coefficients that make the sum of the squared relative errors smallest:
///
///     sum over measurements of (1 - sum over terms of coefficient · term / measured)²
///
/// The errors are relative, because sizes span orders of magnitude and the largest would dominate.
/// A term with a negative coefficient is dropped, and the others are fitted again.
/// @throws std::runtime_error  if there are fewer measurements than terms.
[[nodiscard]] FittedCost fit(const CostDescription& cost,
                             std::span<const Measurement> measurements);

[[nodiscard]] double predict(const FittedCost& cost, const SweepSize& size);

} // namespace gnomon::benchmarks
