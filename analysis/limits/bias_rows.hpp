#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/causes/cause.hpp"
#include "analysis/limits/bias_row_inputs.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/taps.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The errors at one constant bias: cause and label of each wrong or partial pixel, the counts of
/// wrong pixels, and all amounts.
struct CauseLayers {
    scene::Image<Cause> cause;
    scene::Image<Label> label;
    CauseCounts counts;
    CauseAmounts amounts;
};

/// Counts and amounts of errors at one constant bias, by cause and label.
struct BiasRow {
    ErrorCounts errors;
    CauseCounts causes;
    CauseAmounts amounts;
};

/// Counts and amounts at each bias, from one pass over the pixels. They equal those of GL's own run
/// at that bias.
/// @param curve    From the inputs' critical biases and classes.
/// @param amounts  Of all errors, at each bias.
/// @param biases   Ascending, 0 or normal.
/// @throws std::invalid_argument  if the images differ in size, if the biases do not ascend, or if
///                                one is neither 0 nor normal.
[[nodiscard]] std::vector<BiasRow> count_rows(const BiasRowInputs& inputs, const BiasCurve& curve,
                                              std::span<const ErrorAmounts> amounts,
                                              std::span<const float> biases);

/// Finds cause and label of each wrong or partial pixel at one bias.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] CauseLayers classify_errors(const BiasRowInputs& inputs, float bias);

} // namespace gnomon::analysis
