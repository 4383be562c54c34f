#include "raster_gl/program.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace gnomon::raster_gl {
namespace {

using Log = std::array<char, 1024>;

std::string first_line(const Log& log)
{
    const std::string text{log.data()};
    return text.substr(0, text.find('\n'));
}

/// @param before  source that precedes the shader.
Shader compile(GLenum stage, std::string_view name, const std::string& before)
{
    const std::string source = fmt::format("{}{}", before, shader_source(name));
    Shader shader{glCreateShader(stage)};
    const char* text = source.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_FALSE) {
        Log log{};
        glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw scene::EnvironmentError(fmt::format(
            "glCompileShader({}) failed: {}: this driver's OpenGL 4.5 is not usable; see `gnomon "
            "doctor`",
            name, first_line(log)));
    }
    return shader;
}

GLint location(const Program& program, const char* name)
{
    return glGetUniformLocation(program.name(), name);
}

} // namespace

Program make_program(const ProgramParts& parts)
{
    std::string preamble = "#version 450 core\n";
    for (const auto& [name, value] : parts.definitions) {
        preamble += fmt::format("#define {} {}\n", name, value);
    }
    Program program{glCreateProgram()};
    const Shader vertex = compile(GL_VERTEX_SHADER, parts.vertex, preamble);
    glAttachShader(program.name(), vertex.name());
    Shader fragment;
    if (!parts.fragment.empty()) {
        fragment = compile(GL_FRAGMENT_SHADER, parts.fragment, preamble + parts.before_fragment);
        glAttachShader(program.name(), fragment.name());
    }
    if (parts.feedback_varying != nullptr) {
        glTransformFeedbackVaryings(program.name(), 1, &parts.feedback_varying,
                                    GL_INTERLEAVED_ATTRIBS);
    }
    glLinkProgram(program.name());
    GLint ok = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE) {
        Log log{};
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw scene::EnvironmentError(fmt::format(
            "glLinkProgram({} + {}) failed: {}: this driver's OpenGL 4.5 is not usable; see "
            "`gnomon doctor`",
            parts.vertex, parts.fragment, first_line(log)));
    }
    return program;
}

void set_uniform(const Program& program, const char* name, float value)
{
    glProgramUniform1f(program.name(), location(program, name), value);
}

void set_uniform(const Program& program, const char* name, std::uint32_t value)
{
    glProgramUniform1ui(program.name(), location(program, name), value);
}

void set_uniform(const Program& program, const char* name, std::span<const float> values)
{
    glProgramUniform1fv(program.name(), location(program, name),
                        static_cast<GLsizei>(values.size()), values.data());
}

void set_uniform(const Program& program, const char* name, const scene::Vec3f& value)
{
    glProgramUniform3fv(program.name(), location(program, name), 1, glm::value_ptr(value));
}

void set_uniform(const Program& program, const char* name, const scene::Vec4f& value)
{
    glProgramUniform4fv(program.name(), location(program, name), 1, glm::value_ptr(value));
}

void set_uniform(const Program& program, const char* name, const scene::Mat4f& value)
{
    set_uniform(program, name, {&value, 1});
}

void set_uniform(const Program& program, const char* name, std::span<const scene::Mat4f> values)
{
    glProgramUniformMatrix4fv(program.name(), location(program, name),
                              static_cast<GLsizei>(values.size()), GL_FALSE,
                              glm::value_ptr(values.front()));
}

} // namespace gnomon::raster_gl
