#include "raster_gl/scene_programs.hpp"

#include "scene/error.hpp"

#include <epoxy/gl.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::raster_gl {

namespace {

const char* defined_as(bool on)
{
    return on ? "1" : "0";
}

/// The vertex shader's outputs.
struct VertexOutputs {
    scene::Measure measure = scene::Measure::clip_depth;
    bool receivers = false;
    bool normals = false;
};

/// @param writer  source that defines write_fragment() for scene.frag; empty for depth only.
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

/// Source that writes codes, distances and triangle indices.
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

namespace {

void set_culling(scene::Cull cull)
{
    if (cull == scene::Cull::none) {
        glDisable(GL_CULL_FACE);
        return;
    }
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(cull == scene::Cull::front ? GL_FRONT : GL_BACK);
}

} // namespace

void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings)
{
    glViewport(0, 0, settings.resolution_texels, settings.resolution_texels);
    glClipControl(GL_LOWER_LEFT, map.clip_range == scene::ClipRange::zero_to_one
                                     ? GL_ZERO_TO_ONE
                                     : GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(map.reversed ? GL_GREATER : GL_LESS);
    set_culling(settings.cull);
}

PolygonOffsetScope::PolygonOffsetScope(const std::optional<methods::PolygonOffset>& offset)
    : is_on_{offset.has_value()}
{
    if (!is_on_) {
        return;
    }
    if (offset->clamp == 0) {
        glPolygonOffset(offset->factor, offset->units);
    } else if (epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_polygon_offset_clamp")) {
        glPolygonOffsetClamp(offset->factor, offset->units, offset->clamp);
    } else if (epoxy_has_gl_extension("GL_EXT_polygon_offset_clamp")) {
        glPolygonOffsetClampEXT(offset->factor, offset->units, offset->clamp);
    } else {
        throw scene::InputError("bias.polygon_offset_clamp: this driver has neither "
                                "GL_ARB_polygon_offset_clamp nor GL_EXT_polygon_offset_clamp; "
                                "remove the key");
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
}

PolygonOffsetScope::~PolygonOffsetScope()
{
    if (is_on_) {
        glPolygonOffset(0, 0);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
}

bool is_large_map(int resolution_texels, int samples)
{
    constexpr std::int64_t largest = std::int64_t{4096} * 4096;
    return std::int64_t{resolution_texels} * resolution_texels * samples > largest;
}

void draw_casters(const GpuScene& scene, const Program& program, int resolution_texels, int samples)
{
    if (is_large_map(resolution_texels, samples)) {
        scene.draw_casters_in_parts(program);
    } else {
        scene.draw_casters(program);
    }
}

} // namespace gnomon::raster_gl
