#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// Exponential shadow maps: docs/methods/esm.md.
[[nodiscard]] Method exponential_map();

/// Exponential variance shadow maps: docs/methods/evsm.md.
[[nodiscard]] Method exponential_variance_map();

/// Moment shadow maps with four moments: docs/methods/msm.md.
[[nodiscard]] Method moment_map();

/// Percentage-closer filtering with kernels of any radius (Reeves, Salesin and Cook 1987): the mean
/// of comparisons with texels on a grid, in a Poisson disc or on a spiral.
[[nodiscard]] Method percentage_closer();

/// Percentage-closer soft shadows (Fernando 2005): blockers around the receiver give the penumbra's
/// width, which is the radius of the mean of comparisons.
[[nodiscard]] Method percentage_closer_soft_shadows();

/// Index shadow maps ("primitive_id"): compares the triangle that the light sees with the
/// receiver's.
[[nodiscard]] Method primitive_map();

/// Shadow maps of the two surfaces nearest to the light. Compares with the middle between them (Woo
/// 1992), with the second (Wang and Molnar 1994), or with the middle, but at most a bias behind the
/// first (Weiskopf and Ertl 2003).
[[nodiscard]] Method second_layer_map();

/// Shadow volumes, without a map: receivers inside the volume behind a caster are in shadow.
[[nodiscard]] Method shadow_volumes();

/// Variance shadow maps: docs/methods/vsm.md.
[[nodiscard]] Method variance_map();

} // namespace gnomon::methods
