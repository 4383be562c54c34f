#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/evaluation.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "renderers/reference.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The lookup as far as the case records it.
/// @param has_maps  The light has several maps.
[[nodiscard]] scene::LookupLayers recorded_lookup(const scene::CaseLayers& layers, bool has_maps);

/// The number of equal taps whose shares the mask's values are, each to a float32's rounding.
/// @return  0 if they are not, or the filter is not known.
[[nodiscard]] int taps_of_mask(const Case& subject, const scene::Job& job);

/// Finds the causes of a case's wrong pixels as far as its data allow. Notes in `evaluation` which
/// ones cannot be known, and why.
/// @param comparison  With its view, truth, lookup and evaluation.
void find_case_causes(const Case& subject, const renderers::RoundedReference& truth,
                      Comparison& comparison);

/// Which pixels their bias makes wrong, if only r and d of a single tap are known: those that the
/// verdict without any bias, r <= d (reversed: r >= d), gets right (V1 of docs/causes.md).
/// @param layers  With `z_light` and `z_map`.
[[nodiscard]] BiasCauses find_bias_causes(const scene::CaseLayers& layers,
                                          const scene::Truth& truth, bool reversed);

/// The keys and layers that a case lacks for the causes of all its wrong pixels; empty if it lacks
/// none.
///
/// With the camera, the shadow map's settings, r, d and the places of the lookups, causes and
/// labels are found as for GL.
/// @param job  The file's, with defaults for the keys that it leaves out.
[[nodiscard]] std::vector<std::string> missing_for_causes(const scene::CaseFile& file,
                                                          const scene::Job& job,
                                                          const scene::CaseLayers& layers);

/// How the case's camera and shadow map contradict its image, in words with numbers; empty if they
/// agree.
/// @param receivers  The triangle of each pixel.
[[nodiscard]] std::string find_disagreement(const scene::View& view,
                                            const scene::CaseLayers& layers,
                                            const scene::TriangleScene& triangles,
                                            const scene::Image<std::uint32_t>& receivers,
                                            double tolerance_m);

/// Compares the places of a case's lookups with those that its normal offset gives, along the
/// normals of triangles and of vertices, at scored pixels.
/// @param comparison  The case's, with its whole camera and map.
/// @return  The contradiction with its size and a remedy; empty if there is none, or the case has
///          no offset along normals.
[[nodiscard]] std::string check_offset(const Comparison& comparison,
                                       const scene::CaseLayers& layers);

/// What the case recorded of a lookup, and what follows from that.
/// @param job  As the case describes it.
/// @param own  The lookup's layers, with the view's biases.
[[nodiscard]] ObservedLookup observe_recorded(const scene::CaseLayers& layers,
                                              const scene::Job& job, const scene::View& view,
                                              scene::LookupLayers own);

} // namespace gnomon::analysis
