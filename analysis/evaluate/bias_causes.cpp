#include "analysis/evaluate/bias_causes.hpp"

#include "analysis/lookup/lookup_rule.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cmath>
#include <cstddef>

namespace gnomon::analysis {

BiasCauses find_bias_causes(const scene::CaseLayers& layers, const scene::Truth& truth,
                            bool reversed)
{
    const LookupRule rule{.reversed = reversed};
    const auto& classes = truth.pixel_class;
    BiasCauses found{scene::Image<Cause>{classes.size()}, scene::Image<Label>{classes.size()}};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const bool is_lit = scene::is_lit(classes[i]);
        if (!scene::is_scored(classes[i]) || scene::is_lit(layers.mask[i]) == is_lit) {
            continue;
        }
        const float r = layers.z_light[i];
        const float d = layers.z_map[i];
        const bool compares = std::isfinite(r) && std::isfinite(d);
        if (!compares || rule.is_lit(r, d) != is_lit) {
            ++found.unknown;
            continue;
        }
        found.cause[i] = Cause::bias;
        found.label[i] = is_lit ? Label::overshadow : Label::peter_panning;
        ++(is_lit ? found.overshadow : found.peter_panning);
    }
    return found;
}

} // namespace gnomon::analysis
