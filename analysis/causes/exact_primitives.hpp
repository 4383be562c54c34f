#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "scene/image.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// V2 of a lookup that compares triangles: lit iff the exact first hit of the texel's ray is the
/// receiver's own, whatever the bias; where there is no texel, what the border mode says.
/// @param receivers  the triangle that each pixel shows.
/// @return  −∞ or +∞ for the scored pixels that are wrong without bias; 0 elsewhere.
[[nodiscard]] ExactReruns find_exact_primitives(const CauseInputs& inputs,
                                                const scene::Image<std::uint32_t>& receivers);

} // namespace gnomon::analysis
