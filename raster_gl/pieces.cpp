#include "raster_gl/pieces.hpp"

#include <fmt/format.h>

namespace gnomon::raster_gl {

std::string pieces_before_shader(std::string_view source, const methods::Piece& piece)
{
    return fmt::format("#line 1 1\n{}#line 1 2\n{}#line 1 0\n", shader_source(source), piece.glsl);
}

std::string program_key(const methods::Piece& piece)
{
    std::string key{piece.glsl};
    for (const methods::Definition& definition : piece.definitions) {
        key += fmt::format(" {}={}", definition.name, definition.value);
    }
    return key;
}

void add_definitions(const methods::Piece& piece, Definitions& definitions)
{
    for (const methods::Definition& definition : piece.definitions) {
        definitions.emplace_back(definition.name, definition.value);
    }
}

void set_uniforms(const Program& program, const methods::Piece& piece)
{
    for (const methods::Uniform& uniform : piece.uniforms) {
        set_uniform(program, uniform.name.c_str(), uniform.values);
    }
}

} // namespace gnomon::raster_gl
