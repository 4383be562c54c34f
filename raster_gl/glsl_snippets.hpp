#pragma once

#include "methods/bias_term.hpp"
#include "methods/lookup_traits.hpp"
#include "methods/passes.hpp"
#include "raster_gl/program.hpp"
#include "scene/view/view.hpp"

#include <span>
#include <string>
#include <string_view>

namespace gnomon::raster_gl {

/// The source that precedes a shader which calls a method's snippet: the declarations that the
/// snippet may use, then the snippet.
/// @param source  a name for `shader_source`. Its lines are numbered as source string 1 in a
///                driver's log, the snippet's as 2, the shader's own as 0.
/// @param biases  source that precedes the snippet, from `bias_functions`; numbered from source
///                string 3.
[[nodiscard]] std::string snippets_before_shader(std::string_view source,
                                                 const methods::GlslSnippet& snippet,
                                                 std::string_view biases = {});

/// A cache key for a program: its source and its definitions.
[[nodiscard]] std::string program_key(std::string_view text, const Definitions& definitions);

/// The snippets of the bias terms, numbered from source string 4, and the functions through which
/// shaders/lookup.frag calls them in list order.
[[nodiscard]] std::string bias_functions(std::span<const methods::ActiveBias> biases);

/// Whether each tap has its own reference depth; `gradient_of_taps` is then defined.
[[nodiscard]] bool has_gradient_of_taps(std::span<const methods::ActiveBias> biases);

/// Appends the snippet's preprocessor definitions.
void add_definitions(const methods::GlslSnippet& snippet, Definitions& definitions);

void set_uniforms(const Program& program, const methods::GlslSnippet& snippet);

/// Source that places the taps of a kernel (shaders/scattered_taps.glsl); empty if they form a
/// square of texels.
[[nodiscard]] std::string scattered_taps_source(const methods::ScatteredTaps& taps);

/// Appends the definitions for that source and for shaders that include it.
void add_definitions(const methods::ScatteredTaps& taps, Definitions& definitions);

/// Uploads the CPU's tables of tap positions, radius and rotations; does nothing if the taps form a
/// square of texels.
/// @param resolution_texels  of each map in the view.
void set_uniforms(const Program& lookup, const methods::ScatteredTaps& taps,
                  const scene::View& view, int resolution_texels);

/// Source that chooses among a light's maps; empty if there is only one.
[[nodiscard]] std::string map_choice(const scene::View& view);

/// Sets the uniforms of the light, its maps and the camera.
void set_uniforms(const Program& lookup, const scene::View& view);

} // namespace gnomon::raster_gl
