#pragma once

#include "analysis/comparison/evaluation.hpp"
#include "analysis/evaluate/position_check.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/view/view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What a case lacks for the causes of all wrong pixels, by the names of keys and layers; empty if
/// it lacks nothing.
///
/// With the whole camera, the shadow map's settings, r, d and where the map was looked up, causes
/// and labels are found as those of GL are.
/// @param job  what the file says, with the defaults of what it does not.
[[nodiscard]] std::vector<std::string> missing_for_causes(const scene::CaseFile& file,
                                                          const scene::Job& job,
                                                          const scene::CaseLayers& layers);

/// How the camera and the shadow map that a case describes differ from its image: in words, with
/// numbers; empty if they do not.
/// @param receivers  T of each pixel.
[[nodiscard]] std::string find_disagreement(const scene::View& view,
                                            const scene::CaseLayers& layers,
                                            const scene::TriangleScene& triangles,
                                            const scene::Image<std::uint32_t>& receivers,
                                            double tolerance_m);

/// The mistake of an image that is flipped against the camera of its case; empty if it is not, or
/// if the camera has no perspective.
[[nodiscard]] std::optional<ImportMistake> check_camera(const scene::View& view,
                                                        const scene::CaseLayers& layers);

} // namespace gnomon::analysis
