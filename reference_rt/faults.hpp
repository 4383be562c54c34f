#pragma once

#include "reference_rt/contact.hpp"
#include "reference_rt/truth.hpp"
#include "scene/triangles.hpp"

#include <cstdint>

namespace gnomon::reference_rt {

/// Faults that tests put into the truth, to see that its checkers find them. By default none.
struct Faults {
    Sign light_sign = 1;      ///< −1 flips the filtered sign: the light's side of a triangle
    double padding_share = 1; ///< 0 leaves Embree's boxes as tight as they round
    std::uint32_t hidden_triangle = scene::no_triangle; ///< this one Embree never meets
};

/// A reference scene with all hierarchies of the exact truth, and these faults.
/// @throws scene::EnvironmentError  if Embree fails.
[[nodiscard]] ReferenceScene make_faulty_scene(const scene::TriangleScene& triangles,
                                               const Faults& faults);

} // namespace gnomon::reference_rt
