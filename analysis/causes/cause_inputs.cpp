#include "analysis/causes/cause_inputs.hpp"

#include <stdexcept>

namespace gnomon::analysis {

void require_cause_inputs(const CauseInputs& inputs)
{
    const scene::ImageSize size = inputs.truth.pixel_class.size();
    for (const scene::LookupLayers* layers : {&inputs.job, &inputs.unbiased}) {
        if (layers->samples.size() != size || layers->texels.size() != size) {
            throw std::invalid_argument("causes: lookup and truth differ in size");
        }
    }
    const scene::ImageSize maps = inputs.map_depths.size();
    const bool has_maps = !inputs.map_depths.empty() && maps.width_px == inputs.resolution_texels &&
                          maps.height_px % maps.width_px == 0;
    if (!inputs.rule.traits.has_one_tap() && !has_maps) {
        throw std::invalid_argument("causes: map_depths does not have the map's size");
    }
    if (!inputs.rule.traits.compares_depths() &&
        (inputs.exact_reruns == nullptr || inputs.exact_reruns->half.size() != size)) {
        throw std::invalid_argument("causes: exact_reruns is missing");
    }
}

} // namespace gnomon::analysis
