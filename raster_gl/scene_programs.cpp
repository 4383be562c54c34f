#include "raster_gl/scene_programs.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace gnomon::raster_gl {
namespace {

const char* defined_as(bool on)
{
    return on ? "1" : "0";
}

/// What fragments get of their vertices.
struct VertexOutputs {
    scene::Measure measure = scene::Measure::clip_depth;
    bool receivers = false;
    bool normals = false;
};

/// @param writer  text with write_fragment() for scene.frag; empty: there are depths alone.
ProgramParts scene_parts(const VertexOutputs& outputs, std::string writer)
{
    ProgramParts parts{"scene.vert", {}, measure_definitions(outputs.measure)};
    parts.definitions.emplace_back("RECEIVERS", defined_as(outputs.receivers));
    parts.definitions.emplace_back("VERTEX_NORMALS", defined_as(outputs.normals));
    if (!writer.empty()) {
        parts.fragment = "scene.frag";
        parts.before_fragment = std::move(writer);
    }
    return parts;
}

/// Codes and measures in place of GL's depths, and which triangle.
std::string caster_writer()
{
    std::string text;
    for (const char* const name :
         {"depth_codes.glsl", "stored_measure.glsl", "written_casters.glsl"}) {
        text += shader_source(name);
    }
    return text;
}

} // namespace

Definitions measure_definitions(scene::Measure measure)
{
    return {{"ALONG_RAY", defined_as(measure == scene::Measure::ray)},
            {"ALONG_AXIS", defined_as(measure == scene::Measure::axis)}};
}

CasterOutput caster_output(scene::MapContent content, scene::DepthFormat format, bool primitives)
{
    const bool is_converted = traits_of(format).conversion == scene::Conversion::shader;
    return {content, is_converted ? std::optional{format.kind} : std::nullopt, primitives};
}

Program make_caster_program(const CasterOutput& output)
{
    using Kind = scene::DepthFormat::Kind;
    const scene::MapContentTraits& traits = traits_of(output.content);
    const bool is_written = !traits.is_gl_depth() || output.converted || output.primitives;
    ProgramParts parts =
        scene_parts({.measure = traits.measure}, is_written ? caster_writer() : std::string{});
    parts.definitions.emplace_back("PRIMITIVES", defined_as(output.primitives));
    for (const auto& [name, kind] : {std::pair{"UNORM", Kind::unorm},
                                     {"RED_FLOAT", Kind::r32f},
                                     {"RED_HALF", Kind::r16f},
                                     {"BYTES", Kind::rgba8}}) {
        parts.definitions.emplace_back(name, defined_as(output.converted == kind));
    }
    return make_program(parts);
}

Program make_peeling_program()
{
    return make_program(scene_parts({}, std::string{shader_source("depth_peeling.glsl")}));
}

Program make_receiver_program(bool has_normals)
{
    return make_program(scene_parts({.receivers = true, .normals = has_normals},
                                    std::string{shader_source("receivers.glsl")}));
}

Program make_position_program()
{
    ProgramParts parts = scene_parts({}, {});
    parts.feedback_varying = "gl_Position";
    return make_program(parts);
}

} // namespace gnomon::raster_gl
