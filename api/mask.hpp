#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/loaded_case.hpp"
#include "api/scene.hpp"
#include "scene/image.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/vec.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::api {

/// Another renderer's shadow mask in memory, with its pixels' positions and normals. All images
/// have the same size.
struct Mask {
    scene::Image<float> values; ///< 1 lit, 0 shadowed, between for filtered lookups
    /// P [m]; NaN for pixels that are not scored. Empty to take the camera's pixel centres.
    scene::Image<scene::Vec3f> positions;
    /// Geometric normal on the visible side, of any length; may be empty.
    scene::Image<scene::Vec3f> normals;
    std::optional<scene::Vec3d> eye; ///< position of a perspective camera [m]
    bool has_fractions = false;      ///< whether fractions in the mask are intended
    /// The keys of the light; without positions also of the camera; and any others that are known.
    std::vector<scene::Override> keys;
    std::optional<double> tolerance_m; ///< as for `analysis::check_case`
};

/// A mask's comparison with the truth, and the mesh that it refers to.
struct EvaluatedMask {
    std::unique_ptr<const CaseMesh> mesh;
    analysis::Comparison comparison;
};

/// Compares each pixel of a mask with the truth.
/// @param threads  of the reference; 0 for all cores.
/// @throws scene::InputError  if a value is outside [0, 1], sizes differ, a key is unknown, or the
///                            mask has a recognised mistake.
[[nodiscard]] EvaluatedMask evaluate(const Scene& scene, Mask mask, int threads = 0);

} // namespace gnomon::api
