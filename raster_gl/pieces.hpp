#pragma once

#include "methods/passes.hpp"
#include "raster_gl/program.hpp"

#include <string>
#include <string_view>

namespace gnomon::raster_gl {

/// What comes before a shader that calls a method's piece: what the piece may read, and the piece.
/// @param source  a name for `shader_source`. A driver's log counts its lines as of text 1, those
/// of
///                the piece as of text 2, and the shader's own as of text 0.
[[nodiscard]] std::string pieces_before_shader(std::string_view source,
                                               const methods::Piece& piece);

/// A text that tells pieces apart whose programs differ: all but the uniforms.
[[nodiscard]] std::string program_key(const methods::Piece& piece);

/// Appends what the piece is compiled with.
void add_definitions(const methods::Piece& piece, Definitions& definitions);

/// Sets the piece's uniforms.
void set_uniforms(const Program& program, const methods::Piece& piece);

} // namespace gnomon::raster_gl
