#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/case_session.hpp"
#include "api/scene.hpp"
#include "scene/image.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/vec.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::api {

/// Another renderer's shadow mask in memory, and what it says of its pixels. Images are of one
/// size.
struct Mask {
    scene::Image<float> values; ///< 1 lit, 0 shadowed, between for filtered lookups
    /// P [m]; NaN where nothing is to be judged. Empty: what the camera's pixel centres show.
    scene::Image<scene::Vec3f> positions;
    /// Empty, or the geometric normal on the side that is seen, of any length.
    scene::Image<scene::Vec3f> normals;
    std::optional<scene::Vec3d> eye; ///< of a perspective camera [m]
    bool has_fractions = false;      ///< fractions of the mask are meant
    /// The light; without positions the camera; and whatever else of a job is known.
    std::vector<scene::Override> keys;
    std::optional<double> tolerance_m; ///< as `analysis::check_case` has it
};

/// A mask compared with the truth, and the mesh that the comparison refers to.
struct EvaluatedMask {
    std::unique_ptr<const CaseMesh> mesh;
    analysis::Comparison comparison;
};

/// Decides for each pixel of a mask whether it is right.
/// @param threads  of the reference; 0: all cores.
/// @throws scene::InputError  if a value is not a share of light, if sizes differ, if the keys are
///                            not those of a job, or if the mask looks like a mistake, which it
///                            names.
[[nodiscard]] EvaluatedMask evaluate(const Scene& scene, Mask mask, int threads = 0);

} // namespace gnomon::api
