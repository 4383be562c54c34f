#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/causes/cause.hpp"
#include "analysis/limits/bias_row_inputs.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/tap_criticals.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Each wrong or partial pixel's cause and label with one constant bias, how many there are of each
/// that are wrong, and the amounts of all.
struct CauseLayers {
    scene::Image<Cause> cause;
    scene::Image<Label> label;
    CauseCounts counts;
    CauseAmounts amounts;
};

/// Wrong pixels, and amounts of error, by cause and label with one constant bias.
struct BiasRow {
    ErrorCounts errors;
    CauseCounts causes;
    CauseAmounts amounts;
};

/// The counts and amounts at each bias, from one pass over the pixels: those that GL's own run with
/// that bias would give.
/// @param curve    Of the inputs' critical biases and classes.
/// @param amounts  Of all errors, at each bias.
/// @param biases   Ascending, 0 or normal.
/// @throws std::invalid_argument  if the images differ in size, the biases do not ascend, or one is
///                                neither 0 nor normal.
[[nodiscard]] std::vector<BiasRow> count_rows(const BiasRowInputs& inputs, const BiasCurve& curve,
                                              std::span<const ErrorAmounts> amounts,
                                              std::span<const float> biases);

/// The wrong and partial pixels of one bias, one by one.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] CauseLayers classify_errors(const BiasRowInputs& inputs, float bias);

} // namespace gnomon::analysis
