#pragma once

#include "scene/case/case_layers.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

namespace gnomon::analysis {

/// The lookups of a case with other constant and slope biases: its receivers, places and map, each
/// tap compared in float32 as `LookupRule` has it, and counted by its exact weight, which a driver
/// rounds. Nothing is drawn, so that no other setting can be asked.
class RecordedLookup {
public:
    /// @param layers  with r, places and the map (`missing_for_causes`); must outlive this.
    explicit RecordedLookup(const scene::CaseLayers& layers) : layers_{layers} {}

    /// Whether that answers: verdicts are made of comparisons with the map's texels.
    [[nodiscard]] bool answers(const scene::Job& job) const;

    /// Without any bias the case's own record of it where there is one.
    [[nodiscard]] scene::LookupLayers look_up(const scene::Job& job, const scene::View& view) const;

    /// The smallest constant bias of each pixel with which `look_up` lights it.
    [[nodiscard]] scene::Image<float> find_critical_biases(const scene::Job& job,
                                                           const scene::View& view) const;

private:
    [[nodiscard]] scene::LookupLayers own() const;

    const scene::CaseLayers& layers_;
};

} // namespace gnomon::analysis
