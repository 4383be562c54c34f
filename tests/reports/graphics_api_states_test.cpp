#include "reports/tables/graphics_api_states.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The lines of all interfaces.
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

} // namespace
} // namespace gnomon::reports
