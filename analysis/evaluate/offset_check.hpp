#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/case/case_layers.hpp"

#include <string>

namespace gnomon::analysis {

/// Compares where a case's lookups were with where the normal offset that it describes leads,
/// along the normals of triangles and along those of vertices, at scored pixels.
/// @param comparison  of the case, with its whole camera and map.
/// @return  What does not fit, with the size, and which key would; empty where all does, or the
///          case has no offset along normals.
[[nodiscard]] std::string check_offset(const Comparison& comparison,
                                       const scene::CaseLayers& layers);

} // namespace gnomon::analysis
