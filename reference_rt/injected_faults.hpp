#pragma once

#include "reference_rt/exact/contact.hpp"
#include "scene/geometry/triangles.hpp"

#include <cstdint>

namespace gnomon::reference_rt {

/// Faults that tests put into the truth, to see that its checkers find them. By default none.
struct Faults {
    Sign light_sign = 1;      ///< −1 flips the filtered sign: the light's side of a triangle
    double padding_share = 1; ///< 0 leaves Embree's boxes as tight as they round
    std::uint32_t hidden_triangle = scene::no_triangle; ///< this one Embree never meets
};

} // namespace gnomon::reference_rt
