#pragma once

#include "analysis/causes/pixel_causes.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/tap_criticals.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

namespace gnomon::analysis {

/// What rows are counted from; images of one size.
struct BiasRowInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::LookupLayers& deciding;      ///< from `deciding_samples`
    const scene::Image<float>& critical_bias; ///< with the rule's slope; or `criticals_of_verdicts`
    const PixelCauses& causes;
    LookupRule rule;
    const TapCriticals* taps = nullptr; ///< with the rule's slope; nullptr where one texel is read
    /// Whether `deciding` has the verdicts, and `critical_bias` no more than they say: of one bias.
    bool verdicts_are_given = false;
};

} // namespace gnomon::analysis
