#pragma once

#include "analysis/causes/pixel_causes.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/taps.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

namespace gnomon::analysis {

/// Inputs for counting rows; all images have one size.
struct BiasRowInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::LookupLayers& deciding;      ///< from `deciding_samples`
    const scene::Image<float>& critical_bias; ///< with the rule's slope; or `criticals_of_verdicts`
    const PixelCauses& causes;
    LookupRule rule;
    const TapCriticals* taps = nullptr; ///< with the rule's slope; null if one texel is read
    /// Whether `deciding` holds the verdicts of one bias, and `critical_bias` only reproduces them.
    bool verdicts_are_given = false;
};

} // namespace gnomon::analysis
