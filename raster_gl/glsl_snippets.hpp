#pragma once

#include "methods/bias_term.hpp"
#include "methods/passes.hpp"
#include "raster_gl/program.hpp"

#include <span>
#include <string>
#include <string_view>

namespace gnomon::raster_gl {

/// What comes before a shader that calls a method's piece: what the piece may read, and the piece.
/// @param source  a name for `shader_source`. A driver's log counts its lines as of text 1, those
///                of the piece as of text 2, and the shader's own as of text 0.
/// @param biases  text that comes before the piece, from `bias_functions`: counted from text 3.
[[nodiscard]] std::string snippets_before_shader(std::string_view source,
                                                 const methods::GlslSnippet& snippet,
                                                 std::string_view biases = {});

/// A text that tells programs apart: what they are made of, and what it is compiled with.
[[nodiscard]] std::string program_key(std::string_view text, const Definitions& definitions);

/// The pieces of bias terms, each a text of its own from 4 on, and the functions that call them for
/// raster_gl/shaders/lookup.frag, each term in the order of the list.
[[nodiscard]] std::string bias_functions(std::span<const methods::ActiveBias> biases);

/// Whether each tap has a reference depth of its own: then there is `gradient_of_taps`.
[[nodiscard]] bool has_gradient_of_taps(std::span<const methods::ActiveBias> biases);

/// Appends what the piece is compiled with.
void add_definitions(const methods::GlslSnippet& snippet, Definitions& definitions);

/// Sets the piece's uniforms.
void set_uniforms(const Program& program, const methods::GlslSnippet& snippet);

} // namespace gnomon::raster_gl
