#include "reports/tune/tuned_setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The lines of all APIs.
std::string states_of(const char* format)
{
    analysis::TunedSetting setting;
    setting.map.depth_format = scene::depth_format_from_name(format).value();
    std::string text;
    for (const ApiState& state : api_states(setting)) {
        text += fmt::format("{}\n", fmt::join(state.lines, "\n"));
    }
    return text;
}

TEST(GraphicsApiStates, OfADepthFormatCompareInTheSampler)
{
    const std::string text = states_of("d16");
    EXPECT_THAT(text, HasSubstr("D3D12_DEPTH_STENCIL_VIEW_DESC::Format = DXGI_FORMAT_D16_UNORM"));
    EXPECT_THAT(text, HasSubstr("VkSamplerCreateInfo::compareOp"));
    EXPECT_THAT(text, Not(HasSubstr("colour target")));
}

TEST(GraphicsApiStates, OfAColourFormatCompareInTheShader)
{
    const std::string text = states_of("rgba8");
    EXPECT_THAT(text, HasSubstr("GL_RGBA8"));
    EXPECT_THAT(text,
                HasSubstr("D3D12_RENDER_TARGET_VIEW_DESC::Format = DXGI_FORMAT_R8G8B8A8_UNORM"));
    EXPECT_THAT(text, HasSubstr("VK_FORMAT_R8G8B8A8_UNORM"));
    EXPECT_THAT(text, HasSubstr("cleared to white"));
    EXPECT_THAT(text, HasSubstr(", packed"));
    EXPECT_THAT(text, Not(HasSubstr("VkSamplerCreateInfo::compareOp")));
    EXPECT_THAT(text, Not(HasSubstr("D3D12_SAMPLER_DESC")));
    EXPECT_THAT(states_of("r16f"), Not(HasSubstr(", packed")));
    EXPECT_THAT(states_of("r16f"), HasSubstr("lit = r <= texture(shadow_map, uv).r;"));
}

TEST(GraphicsApiStates, SayWhereNoFormatStoresIt)
{
    EXPECT_THAT(states_of("u13"), HasSubstr("no depth format of GL stores u13"));
}

TEST(GraphicsApiStates, HaveThePolygonOffsetOfTheJob)
{
    analysis::TunedSetting setting;
    std::string text;
    for (const ApiState& state : api_states(setting, methods::PolygonOffset{1.5F, 2.25F, 0.125F})) {
        text += fmt::format("{}\n", fmt::join(state.lines, "\n"));
    }
    EXPECT_THAT(text, HasSubstr("glPolygonOffsetClamp(1.5, 2.25, 0.125);"));
    EXPECT_THAT(text,
                HasSubstr("DepthBias = 3, SlopeScaledDepthBias = 1.5, DepthBiasClamp = 0.125,"));
    EXPECT_THAT(text, HasSubstr("depthBiasEnable = VK_TRUE, depthBiasConstantFactor = 2.25, "
                                "depthBiasSlopeFactor = 1.5, depthBiasClamp = 0.125"));
}

/// The lines of one API.
std::string lines_of(const analysis::TunedSetting& setting, const std::string& api,
                     std::span<const std::string> other_biases = {})
{
    for (const ApiState& state : api_states(setting, {}, other_biases)) {
        if (state.api == api) {
            return fmt::format("{}", fmt::join(state.lines, "\n"));
        }
    }
    return {};
}

TEST(GraphicsApiStates, HaveEachBiasInTheLineOfTheShaderThatAppliesIt)
{
    analysis::TunedSetting setting;
    setting.bias.rounded.bias = 0.00028F;
    setting.slope = 0.0012;
    setting.normal_texels = 2;
    setting.map.resolution_texels = 512;
    const std::string gl = lines_of(setting, "GL");
    EXPECT_THAT(gl,
                HasSubstr("GLSL of the lookup: vec3 p = position + 2.0 * 2.0 * light_clip.w / "
                          "(512.0 * min(light_projection[0][0], abs(light_projection[1][1]))) * "
                          "N;"));
    EXPECT_THAT(gl, HasSubstr("float bias = 0.00028 + 0.0012 * length(cross(N, L)) / "
                              "abs(dot(N, L));"));
    EXPECT_THAT(gl, HasSubstr("texture(shadow_map, vec3(uv, r - bias));"));
    EXPECT_THAT(lines_of(setting, "Vulkan"), HasSubstr("vec3(uv, r - bias)"));
    const std::string direct3d = lines_of(setting, "Direct3D");
    EXPECT_THAT(direct3d, HasSubstr("HLSL of the lookup: float3 p = position + 2.0"));
    EXPECT_THAT(direct3d, HasSubstr("SampleCmpLevelZero(shadow_sampler, uv, r - bias);"));
    setting.map.frustum.reversed = true; // depth grows towards the light
    EXPECT_THAT(lines_of(setting, "GL"), HasSubstr("vec3(uv, r + bias)"));
}

TEST(GraphicsApiStates, ReadWhatTheKindOfMapHolds)
{
    analysis::TunedSetting setting;
    setting.map.layout = scene::MapLayout::cascades;
    EXPECT_THAT(lines_of(setting, "GL"), HasSubstr("texture(shadow_map, vec4(uv, cascade, r));"));
    EXPECT_THAT(lines_of(setting, "Direct3D"),
                HasSubstr("SampleCmpLevelZero(shadow_sampler, float3(uv, cascade), r);"));
    setting.map.layout = scene::MapLayout::cube;
    EXPECT_THAT(lines_of(setting, "GL"), HasSubstr("texture(shadow_map, vec4(direction, r));"));
    setting.filter = scene::Filter::linear; // compares the mean depth
    EXPECT_THAT(lines_of(setting, "Direct3D"),
                HasSubstr("r <= shadow_map.Sample(shadow_sampler, direction).r;"));
}

TEST(GraphicsApiStates, SayWhereThereIsNoBias)
{
    const std::string text = lines_of({}, "GL");
    EXPECT_THAT(text, HasSubstr("vec3(uv, r)); // r: the receiver's depth in [0, 1], without a "
                                "bias"));
    EXPECT_THAT(text, Not(HasSubstr("float bias")));
}

TEST(GraphicsApiStates, DivideMetresByEachCascadesRange)
{
    analysis::TunedSetting setting;
    setting.map.layout = scene::MapLayout::cascades;
    setting.bias.rounded.unit = &scene::bias_in_metres;
    setting.bias.rounded.value = 0.02;
    EXPECT_THAT(lines_of(setting, "GL"),
                HasSubstr("float bias = 0.02 / (far[cascade] - near[cascade]);"));
}

TEST(GraphicsApiStates, NameTheJobsOtherBiases)
{
    const std::vector<std::string> others{"bias.slope_kernels = 1"};
    EXPECT_THAT(lines_of({}, "Vulkan", others), HasSubstr("the job's own bias.slope_kernels = 1"));
}

} // namespace
} // namespace gnomon::reports
