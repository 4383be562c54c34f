#pragma once

#include "reports/tune/shader_lines.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// A job's lookup as shader code.
struct LookupShader {
    /// Declarations, and `float visibility(vec3 position, vec3 N, vec3 L)`, in [0, 1]; with
    /// cascades it also takes the number of the cascade.
    std::vector<std::string> lines;
    std::vector<std::string> cannot; ///< keys of the job that no line applies
    bool has_all_biases = true;      ///< false: `cannot` has a bias
};

/// Writes the lookup of a job of the method `depth`: filter, border mode, and the bias terms with
/// their values. Lengths are in the scene's own units. GLSL has GL's clip space, HLSL Direct3D's.
/// @param constant  Constant bias in the first map [depth units].
/// @throws scene::InputError  for a map whose lookup is not written: a cube, packed depths, several
///                            samples per texel, or another method.
/// Source: docs/formulas.md; raster_gl/shaders/lookup_map.glsl.
[[nodiscard]] LookupShader lookup_shader(ShaderLanguage language, const scene::Job& job,
                                         const scene::View& view, float constant);

} // namespace gnomon::reports
