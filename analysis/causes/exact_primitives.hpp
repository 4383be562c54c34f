#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// V2 of a lookup that compares triangles: lit iff the exact first hit of the texel's ray is the
/// receiver's own, whatever the bias; where there is no texel, what the border mode says.
/// @param receivers  the triangle that each pixel shows.
/// @return  −∞ or +∞ for the scored pixels that are wrong without bias; 0 elsewhere.
[[nodiscard]] ExactReruns find_exact_primitives(const CauseInputs& inputs,
                                                const scene::Image<std::uint32_t>& receivers);

/// Whether no map of these settings can show the triangle of a scored receiver, however fine: where
/// it casts nothing, is culled, or is not between near and far there.
/// @param receivers  the triangle that each pixel shows.
/// @return  1 or 0, by pixel.
[[nodiscard]] scene::Image<std::uint8_t>
find_missing_receivers(const CauseInputs& inputs, const scene::Image<std::uint32_t>& receivers,
                       const scene::TriangleScene& triangles, const scene::Light& light,
                       scene::Cull cull);

} // namespace gnomon::analysis
