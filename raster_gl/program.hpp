#pragma once

#include "raster_gl/gl_object.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {

/// The text of a file under raster_gl/shaders, embedded at build time, without a #version line.
/// @throws std::invalid_argument  if no file has this name.
[[nodiscard]] std::string_view shader_source(std::string_view name);

/// Preprocessor definitions at the start of both shaders.
using Definitions = std::vector<std::pair<std::string, std::string>>;

/// The sources of a program.
struct ProgramParts {
    std::string_view vertex;
    std::string_view fragment; ///< empty for depth-only passes and transform feedback
    Definitions definitions;
    const char* feedback_varying = nullptr; ///< captured by transform feedback, e.g. "gl_Position"
    std::string before_fragment = {};       ///< source that precedes the fragment shader
};

/// Compiles and links.
/// @throws scene::EnvironmentError  with the first line of the driver's log.
[[nodiscard]] Program make_program(const ProgramParts& parts);

/// Sets a uniform by name; ignores one that the compiler removed, as GL does.
void set_uniform(const Program& program, const char* name, float value);
void set_uniform(const Program& program, const char* name, std::uint32_t value);
/// Sets a float or an array of floats.
void set_uniform(const Program& program, const char* name, std::span<const float> values);
void set_uniform(const Program& program, const char* name, const scene::Vec3f& value);
void set_uniform(const Program& program, const char* name, const scene::Vec4f& value);
void set_uniform(const Program& program, const char* name, const scene::Mat4f& value);
void set_uniform(const Program& program, const char* name, std::span<const scene::Mat4f> values);

} // namespace gnomon::raster_gl
