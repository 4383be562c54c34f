#pragma once

#include "analysis/bias_curve.hpp"
#include "analysis/cause.hpp"
#include "analysis/causes.hpp"
#include "analysis/gaps.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "scene/image.hpp"
#include "scene/layers.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Each wrong pixel's cause and label with one constant bias, and how many there are of each.
struct CauseLayers {
    scene::Image<Cause> cause;
    scene::Image<Label> label;
    CauseCounts counts;
};

/// Wrong pixels by cause and label with one constant bias.
struct BiasRow {
    ErrorCounts errors;
    CauseCounts causes;
};

/// What rows are counted from; images of one size.
struct BiasRowInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::LookupLayers& deciding;      ///< from `deciding_samples`
    const scene::Image<float>& critical_bias; ///< with the rule's slope; or `criticals_of_verdicts`
    const scene::Image<PixelCause>& causes;
    LookupRule rule;
};

/// The counts at each bias, from one pass over the pixels: those that GL's own run with that bias
/// would give.
/// @param curve   Of the inputs' critical biases and classes.
/// @param biases  Ascending, 0 or normal.
/// @throws std::invalid_argument  if the images differ in size, the biases do not ascend, or one is
///                                neither 0 nor normal.
[[nodiscard]] std::vector<BiasRow> count_rows(const BiasRowInputs& inputs, const BiasCurve& curve,
                                              std::span<const float> biases);

/// The wrong pixels of one bias, one by one.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] CauseLayers classify_errors(const BiasRowInputs& inputs, float bias);

/// A pixel whose shadow the bias detaches, once it is at least `critical_bias`.
struct PanningGap {
    float critical_bias = 0;
    PixelGap gap;
};

/// The peter-panning lengths at each bias.
/// @param biases  Ascending.
[[nodiscard]] std::vector<Gaps> find_gaps_at(std::vector<PanningGap> gaps,
                                             std::span<const float> biases);

} // namespace gnomon::analysis
