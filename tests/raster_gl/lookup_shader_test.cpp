// The shader code that `gnomon settings --engine glsl` prints gives the verdicts of Gnomon's
// lookup.

#include "gl_case.hpp"

#include "methods_job.hpp"
#include "raster_gl/readback.hpp"
#include "reports/settings/lookup_shader.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {
namespace {

using raster_gl::Program;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using tests::GlCase;

constexpr std::string_view before = R"(#version 450 core
layout(binding = 0) uniform usampler2D triangle;
layout(binding = 1) uniform sampler2D world_position;
layout(binding = 2) uniform sampler2D map_of_pixel;
layout(binding = 5) uniform samplerBuffer normals;
layout(location = 0) out float verdict;
uniform vec4 light;
)";

/// LAST stands for the last arguments.
constexpr std::string_view after = R"(
void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint t = texelFetch(triangle, pixel, 0).r;
    vec3 position = texelFetch(world_position, pixel, 0).xyz;
    vec3 N = texelFetch(normals, t == 0xFFFFFFFFu ? 0 : int(t)).xyz;
    vec3 L = normalize(light.xyz - light.w * position);
    int cascade = int(texelFetch(map_of_pixel, pixel, 0).r);
    float lit = visibility(position, N, LAST);
    verdict = t == 0xFFFFFFFFu ? -1.0 : lit;
}
)";

constexpr const char* vertex_source = R"(#version 450 core
void main()
{
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

raster_gl::Shader compiled(GLenum kind, const std::string& source)
{
    raster_gl::Shader shader{glCreateShader(kind)};
    const char* const text = source.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint is_done = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &is_done);
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader.name(), log.size(), nullptr, log.data());
    EXPECT_EQ(is_done, GL_TRUE) << log.data() << "\n" << source;
    return shader;
}

Program linked(const std::string& fragment_source)
{
    const auto vertex = compiled(GL_VERTEX_SHADER, vertex_source);
    const auto fragment = compiled(GL_FRAGMENT_SHADER, fragment_source);
    Program program{glCreateProgram()};
    glAttachShader(program.name(), vertex.name());
    glAttachShader(program.name(), fragment.name());
    glLinkProgram(program.name()); // an error makes glUseProgram fail, and `check` throw
    return program;
}

std::string code_of(const LookupShader& shader)
{
    return fmt::format("{}\n", fmt::join(shader.lines, "\n"));
}

/// The sampler that the comment in the code asks for.
raster_gl::Sampler sampler_of(const std::string& code)
{
    raster_gl::Sampler sampler = raster_gl::make_sampler();
    const auto has = [&](std::string_view word) { return code.find(word) != std::string::npos; };
    const GLint filter = has("linear filter") ? GL_LINEAR : GL_NEAREST;
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, filter);
    const GLint wrap = has("clamped to the edge") ? GL_CLAMP_TO_EDGE : GL_CLAMP_TO_BORDER;
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, wrap);
    const float border = has("border 1") ? 1 : 0;
    const std::array colour{border, border, border, border};
    glSamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, colour.data());
    if (has(", compares ")) {
        glSamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_FUNC,
                            has("GEQUAL") ? GL_GEQUAL : GL_LEQUAL);
    }
    return sampler;
}

/// The map that each pixel reads, as a texture.
raster_gl::Texture maps_texture(const scene::LookupLayers& lookup, scene::ImageSize size)
{
    scene::Image<float> maps{size};
    for (std::size_t i = 0; i < maps.pixel_count(); ++i) {
        maps[i] = static_cast<float>(scene::map_of(lookup.maps, i));
    }
    return raster_gl::upload(std::move(maps));
}

void set_uniforms(const Program& program, const GlCase& c)
{
    const scene::Light& light = c.view.light;
    const bool is_positional = light.has_position();
    const scene::Vec3f place = is_positional ? scene::Vec3f{light.position}
                                             : scene::Vec3f{-glm::normalize(light.direction)};
    raster_gl::set_uniform(program, "light", scene::Vec4f{place, is_positional ? 1.0F : 0.0F});
    raster_gl::set_uniform(program, "light_position", scene::Vec3f{light.position});
    std::vector<scene::Mat4f> matrices;
    for (const scene::LightFrustum& map : c.view.maps) {
        matrices.push_back(map.light_clip_from_world);
    }
    raster_gl::set_uniform(program, "light_clip_from_world", matrices);
    glProgramUniform1i(program.name(), glGetUniformLocation(program.name(), "shadow_map"), 3);
}

/// Runs the code over the receivers of a case that was looked up.
scene::Image<float> verdicts_of(const std::string& code, const GlCase& c,
                                const scene::LookupLayers& lookup)
{
    std::string main{after};
    main.replace(main.find("LAST"), 4, c.view.maps.size() > 1 ? "L, cascade" : "L");
    const Program program = linked(std::string{before} + code + main);
    const auto size = c.view.image;
    set_uniforms(program, c);
    const raster_gl::Texture maps = maps_texture(lookup, size);
    const raster_gl::Sampler sampler = sampler_of(code);
    const raster_gl::Texture verdicts =
        raster_gl::make_texture(GL_R32F, size.width_px, size.height_px);
    const raster_gl::Framebuffer target = raster_gl::make_framebuffer();
    const raster_gl::VertexArray no_attributes = raster_gl::make_vertex_array();
    glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, verdicts.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, size.width_px, size.height_px);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindTextureUnit(0, c.receivers->triangle.name());
    glBindTextureUnit(1, c.receivers->world_position.name());
    glBindTextureUnit(2, maps.name());
    glBindTextureUnit(3, c.map->depth.name());
    glBindSampler(3, sampler.name());
    c.gpu.bind_normals(5);
    glUseProgram(program.name());
    glBindVertexArray(no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(3, 0);
    auto image = raster_gl::read_texture<float>(verdicts, size, GL_RED, GL_FLOAT);
    tests::shared_context()->check("running a printed lookup");
    return image;
}

struct Compared {
    std::size_t receivers = 0, shadowed = 0, different = 0;
};

/// Compares the code's verdicts with the lookup's.
/// @param constant_factor  scales the constant bias of the code.
Compared compare(GlCase& c, float constant_factor = 1)
{
    c.draw_all();
    const scene::LookupLayers lookup = c.lookup_pass.read();
    const LookupShader shader =
        lookup_shader(ShaderLanguage::glsl, c.job, c.view, c.view.bias.constant * constant_factor);
    EXPECT_THAT(shader.cannot, IsEmpty());
    const scene::Image<float> verdicts = verdicts_of(code_of(shader), c, lookup);
    const auto triangles = raster_gl::read_triangles(*tests::shared_context(), *c.receivers);
    Compared compared;
    for (std::size_t i = 0; i < verdicts.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            continue;
        }
        const float expected = lookup.samples[i].verdict;
        ++compared.receivers;
        compared.shadowed += expected < 1 ? 1U : 0U;
        compared.different += std::abs(verdicts[i] - expected) > 1e-5F ? 1U : 0U;
    }
    return compared;
}

/// Keys that all cases share.
std::vector<scene::Override> with_size(std::vector<scene::Override> keys)
{
    keys.insert(keys.begin(), {{"image.width", "320"},
                               {"image.height", "180"},
                               {"lookup.position", "pixel"},
                               {"shadow_map.resolution", "256"}});
    return keys;
}

struct Job {
    const char* builtin;
    std::vector<scene::Override> keys;
};

void expect_equal_verdicts(const Job& job)
{
    GNOMON_REQUIRE_GL();
    GlCase c{job.builtin, with_size(job.keys)};
    std::string name = job.builtin;
    for (const scene::Override& key : job.keys) {
        name += fmt::format(", {} = {}", key.key, key.value);
    }
    SCOPED_TRACE(name);
    const Compared compared = compare(c);
    EXPECT_GT(compared.receivers, 20000U);
    EXPECT_GT(compared.shadowed, 300U);
    // The code leaves the order of its roundings to the compiler. A verdict may turn where a point
    // lies within an ulp of a texel's border or of the map's depth: fewer than one in a thousand.
    EXPECT_LE(compared.different, compared.receivers / 1000);
}

TEST(LookupShader, GivesTheVerdictsOfTheNearestTexelWithConstantSlopeAndNormalOffset)
{
    const std::vector<scene::Override> biases{{"lookup.filter", "nearest"},
                                              {"bias.constant", "0.0005"},
                                              {"bias.slope", "0.0003"},
                                              {"bias.normal_texels", "1.5"}};
    for (const char* builtin : {"sphere-plane", "yard"}) { // a spot, the sun
        expect_equal_verdicts({builtin, biases});
    }
}

TEST(LookupShader, GivesTheVerdictsOfEachFilter)
{
    for (const char* filter : {"linear", "hardware", "pcf3", "bilinear3", "bilinear5"}) {
        expect_equal_verdicts({"yard", {{"lookup.filter", filter}, {"bias.constant", "0.0005"}}});
    }
}

TEST(LookupShader, GivesTheVerdictsOfEachBiasTerm)
{
    const std::vector<std::vector<scene::Override>> terms{
        {{"bias.normal_m", "0.03"}},
        {{"bias.constant_texels", "1.5"}},
        {{"bias.slope_kernels", "1"}, {"bias.constant", "0.0001"}},
        {{"bias.receiver_plane", "analytic"}, {"bias.constant", "0.0002"}},
        {{"bias.receiver_plane", "analytic"},
         {"bias.receiver_plane_clamp", "0.002"},
         {"bias.constant", "0.0002"}}};
    for (const char* builtin : {"sphere-plane", "yard"}) {
        for (std::vector<scene::Override> keys : terms) {
            keys.push_back({"lookup.filter", "pcf3"});
            expect_equal_verdicts({builtin, keys});
        }
    }
}

TEST(LookupShader, GivesTheVerdictsOfOtherMaps)
{
    const std::vector<scene::Override> reversed{{"shadow_map.reversed", "true"},
                                                {"bias.constant", "0.0005"},
                                                {"bias.slope", "0.0003"},
                                                {"bias.receiver_plane", "analytic"},
                                                {"lookup.filter", "pcf3"}};
    for (const char* builtin : {"sphere-plane", "yard"}) {
        expect_equal_verdicts({builtin, reversed});
    }
    expect_equal_verdicts({"sphere-plane",
                           {{"shadow_map.content", "distance"},
                            {"bias.constant", "0.003"},
                            {"lookup.filter", "pcf3"}}});
    expect_equal_verdicts({"sphere-plane",
                           {{"shadow_map.content", "linear"},
                            {"bias.constant", "0.003"},
                            {"bias.constant_texels", "1"},
                            {"lookup.filter", "nearest"}}});
    expect_equal_verdicts({"yard",
                           {{"shadow_map.layout", "cascades"},
                            {"shadow_map.cascades", "3"},
                            {"bias.constant_m", "0.02"},
                            {"bias.normal_texels", "1"},
                            {"lookup.filter", "pcf3"}}});
}

TEST(LookupShader, GivesTheVerdictsBeyondTheMap)
{
    for (const char* outside : {"lit", "shadowed", "clamp"}) {
        for (const char* filter : {"nearest", "hardware", "pcf5"}) {
            expect_equal_verdicts({"yard",
                                   {{"shadow_map.fit", "fixed"},
                                    {"shadow_map.half_extent", "4"},
                                    {"lookup.outside", outside},
                                    {"lookup.filter", filter},
                                    {"bias.constant", "0.0005"}}});
        }
    }
}

TEST(LookupShader, DiffersWithAnotherBias)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"yard", with_size({{"lookup.filter", "nearest"}, {"bias.constant", "0.0005"}})};
    const Compared compared = compare(c, 0.1F);
    EXPECT_GT(compared.different, compared.receivers / 100);
}

TEST(LookupShader, CompilesWithDerivatives)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"yard", with_size({{"bias.receiver_plane", "derivatives"},
                                {"bias.constant", "0.0002"},
                                {"lookup.filter", "pcf3"}})};
    const Compared compared = compare(c);
    // Gnomon gives the plane up where one of 2 × 2 pixels shows no surface; GL extrapolates.
    EXPECT_LE(compared.different, compared.receivers / 100);
}

/// The code for a scene, without drawing.
std::string written(ShaderLanguage language, const Job& job)
{
    const scene::Job read = tests::builtin_job(job.builtin, with_size(job.keys)).job;
    const scene::SceneFile file = scene::load_scene(read.scene);
    const scene::View view = scene::resolve_view(read, file.scene, file.defaults);
    return code_of(lookup_shader(language, read, view, view.bias.constant));
}

TEST(LookupShader, WritesHlslForDirect3DsClipSpace)
{
    const std::string code = written(ShaderLanguage::hlsl, {"yard",
                                                            {{"lookup.filter", "nearest"},
                                                             {"bias.constant", "0.5"},
                                                             {"bias.slope", "0.25"},
                                                             {"bias.normal_m", "2"}}});
    EXPECT_THAT(code,
                AllOf(HasSubstr("Texture2D<float> shadow_map; // 256 x 256, no comparison"),
                      HasSubstr("float visibility(float3 position, float3 N, float3 L)\n"),
                      HasSubstr("float3 p = position + 2.0 * (dot(N, L) < 0.0 ? -N : N);"),
                      HasSubstr("float4 clip = mul(light_clip_from_world, float4(p, 1.0));"),
                      HasSubstr("float2 uv = ndc.xy * float2(0.5, -0.5) + 0.5;"),
                      HasSubstr("float r = ndc.z;"),
                      HasSubstr("float bias = 0.5 + 0.25 * length(cross(N, L)) / abs(dot(N, L));"),
                      HasSubstr("depth <= shadow_map.Load(int3(int2(tap), 0)) ? 1.0 : 0.0;"),
                      Not(HasSubstr("vec3"))));
    EXPECT_THAT(written(ShaderLanguage::hlsl, {"yard", {{"lookup.filter", "hardware"}}}),
                HasSubstr("float lit = shadow_map.SampleCmpLevelZero(shadow_sampler, uv, r - "
                          "bias);"));
}

TEST(LookupShader, CountsLengthsInTheScenesUnit)
{
    scene::Job job = tests::builtin_job("yard", with_size({{"bias.normal_m", "2"}})).job;
    const scene::SceneFile file = scene::load_scene(job.scene);
    const scene::View view = scene::resolve_view(job, file.scene, file.defaults);
    job.scene.unit_m = 0.01;
    EXPECT_THAT(code_of(lookup_shader(ShaderLanguage::glsl, job, view, 0)),
                HasSubstr("position + 200.0 *"));
}

TEST(LookupShader, NamesTheBiasesThatItLacks)
{
    const scene::Job job = tests::builtin_job("yard", with_size({{"bias.adaptive_m", "0.5"},
                                                                 {"bias.normal_m", "1"},
                                                                 {"bias.normal_from", "vertices"}}))
                               .job;
    const scene::SceneFile file = scene::load_scene(job.scene);
    const LookupShader shader = lookup_shader(
        ShaderLanguage::glsl, job, scene::resolve_view(job, file.scene, file.defaults), 0);
    EXPECT_THAT(shader.cannot,
                ElementsAre("bias.adaptive_m = 0.5", "bias.normal_from = \"vertices\""));
    EXPECT_FALSE(shader.has_all_biases);
}

TEST(LookupShader, RefusesMapsWhoseLookupIsNotWritten)
{
    const auto refuse = [](const Job& job) { (void)written(ShaderLanguage::glsl, job); };
    EXPECT_THROW(refuse({"lamp-room", {}}), scene::InputError); // a cube
    EXPECT_THROW(refuse({"yard", {{"shadow_map.depth_format", "rgba8"}}}), scene::InputError);
    EXPECT_THROW(refuse({"yard", {{"method.name", "vsm"}}}), scene::InputError);
}

} // namespace
} // namespace gnomon::reports
