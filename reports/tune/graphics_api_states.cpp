#include "reports/tune/tuned_setting.hpp"

#include "reports/tune/shader_lines.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using scene::Cull;
using scene::DepthFormat;
using Offset = std::optional<methods::PolygonOffset>;

/// A depth format's name in each API; empty if the API lacks it.
struct FormatNames {
    std::string_view gl;
    std::string_view direct3d;
    std::string_view vulkan;
};

FormatNames names_of(DepthFormat format)
{
    switch (format.kind) {
    case DepthFormat::Kind::d16:
        return {"GL_DEPTH_COMPONENT16", "DXGI_FORMAT_D16_UNORM", "VK_FORMAT_D16_UNORM"};
    case DepthFormat::Kind::d24:
        return {"GL_DEPTH_COMPONENT24", "DXGI_FORMAT_D24_UNORM_S8_UINT",
                "VK_FORMAT_X8_D24_UNORM_PACK32"};
    case DepthFormat::Kind::d32:
        return {"GL_DEPTH_COMPONENT32", "", ""};
    case DepthFormat::Kind::d32f:
        return {"GL_DEPTH_COMPONENT32F", "DXGI_FORMAT_D32_FLOAT", "VK_FORMAT_D32_SFLOAT"};
    case DepthFormat::Kind::r32f:
        return {"GL_R32F", "DXGI_FORMAT_R32_FLOAT", "VK_FORMAT_R32_SFLOAT"};
    case DepthFormat::Kind::r16f:
        return {"GL_R16F", "DXGI_FORMAT_R16_FLOAT", "VK_FORMAT_R16_SFLOAT"};
    case DepthFormat::Kind::rgba8:
        return {"GL_RGBA8", "DXGI_FORMAT_R8G8B8A8_UNORM", "VK_FORMAT_R8G8B8A8_UNORM"};
    case DepthFormat::Kind::unorm:
        break;
    }
    return {};
}

/// The culling state in each API; front faces are counter-clockwise.
FormatNames cull_names(Cull cull)
{
    switch (cull) {
    case Cull::front:
        return {"glEnable(GL_CULL_FACE); glCullFace(GL_FRONT);", "D3D12_CULL_MODE_FRONT",
                "VK_CULL_MODE_FRONT_BIT"};
    case Cull::back:
        return {"glEnable(GL_CULL_FACE); glCullFace(GL_BACK);", "D3D12_CULL_MODE_BACK",
                "VK_CULL_MODE_BACK_BIT"};
    case Cull::none:
        break;
    }
    return {"glDisable(GL_CULL_FACE);", "D3D12_CULL_MODE_NONE", "VK_CULL_MODE_NONE"};
}

std::string no_format(const TunedSetting& setting, std::string_view api)
{
    return fmt::format("no depth format of {} stores {}", api,
                       scene::depth_format_name(setting.map.depth_format));
}

bool is_cube(const TunedSetting& setting)
{
    return setting.map.layout == scene::MapLayout::cube;
}

/// Number of cascades; 0 for other layouts.
int cascades_of(const TunedSetting& setting)
{
    return setting.map.layout == scene::MapLayout::cascades ? setting.map.cascades.count : 0;
}

/// The texture that holds a light's maps.
std::string gl_storage(const TunedSetting& setting, std::string_view format)
{
    const int texels = setting.map.resolution_texels;
    if (const int cascades = cascades_of(setting); cascades > 0) {
        return fmt::format("glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, {0}, {1}, {1}, {2});", format,
                           texels, cascades);
    }
    return fmt::format("glTexStorage2D({2}, 1, {0}, {1}, {1});{3}", format, texels,
                       is_cube(setting) ? "GL_TEXTURE_CUBE_MAP" : "GL_TEXTURE_2D",
                       is_cube(setting) ? " glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);" : "");
}

std::string direct3d_maps(const TunedSetting& setting)
{
    const int cascades = cascades_of(setting);
    const int maps = is_cube(setting) ? 6 : cascades;
    return maps == 0 ? std::string{}
                     : fmt::format(" D3D12_RESOURCE_DESC::DepthOrArraySize = {}; "
                                   "D3D12_SRV_DIMENSION_{}",
                                   maps, cascades > 0 ? "TEXTURE2DARRAY" : "TEXTURECUBE");
}

std::string vulkan_maps(const TunedSetting& setting)
{
    if (const int cascades = cascades_of(setting); cascades > 0) {
        return fmt::format(" arrayLayers = {}; VK_IMAGE_VIEW_TYPE_2D_ARRAY", cascades);
    }
    return is_cube(setting) ? " flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT, arrayLayers = 6" : "";
}

bool is_colour(const TunedSetting& setting)
{
    return traits_of(setting.map.depth_format).is_colour;
}

/// Adds what the shaders must do, unless the map stores GL's own depth.
void add_shader(ApiState& state, const TunedSetting& setting)
{
    if (is_colour(setting)) {
        state.lines.push_back(fmt::format(
            "a colour target beside a depth buffer, cleared to {}: the map's fragment shader "
            "writes "
            "the depth into it{}, and the lookup's compares",
            setting.map.frustum.reversed ? "0" : "white",
            setting.map.depth_format.kind == DepthFormat::Kind::rgba8 ? ", packed" : ""));
    }
    if (const auto& content = traits_of(setting.map.frustum.content); !content.is_gl_depth()) {
        state.lines.push_back(fmt::format("fragment shader of the map: depth = {}, in place of its "
                                          "own; lookup compares the same of the receiver",
                                          content.shader_line));
    }
}

std::string gl_offset(const Offset& offset)
{
    if (!offset) {
        return "glDisable(GL_POLYGON_OFFSET_FILL);";
    }
    return offset->clamp == 0
               ? fmt::format("glEnable(GL_POLYGON_OFFSET_FILL); glPolygonOffset({}, {});",
                             offset->factor, offset->units)
               : fmt::format("glEnable(GL_POLYGON_OFFSET_FILL); glPolygonOffsetClamp({}, {}, {});",
                             offset->factor, offset->units, offset->clamp);
}

/// Direct3D takes whole units; rounding away from 0 prevents as much self-shadowing.
std::string direct3d_offset(const Offset& offset)
{
    if (!offset) {
        return "DepthBias = 0, SlopeScaledDepthBias = 0";
    }
    const float units = std::copysign(std::ceil(std::abs(offset->units)), offset->units);
    std::string text =
        fmt::format("DepthBias = {:.0f}, SlopeScaledDepthBias = {}", units, offset->factor);
    return offset->clamp == 0 ? text : text + fmt::format(", DepthBiasClamp = {}", offset->clamp);
}

std::string vulkan_offset(const Offset& offset)
{
    return offset ? fmt::format("depthBiasEnable = VK_TRUE, depthBiasConstantFactor = {}, "
                                "depthBiasSlopeFactor = {}, depthBiasClamp = {}",
                                offset->units, offset->factor, offset->clamp)
                  : "depthBiasEnable = VK_FALSE";
}

ApiState gl_state(const TunedSetting& setting, const Offset& offset)
{
    const std::string_view format = names_of(setting.map.depth_format).gl;
    if (format.empty()) {
        return {"GL", {no_format(setting, "GL")}};
    }
    const bool reversed = setting.map.frustum.reversed;
    return {"GL",
            {gl_storage(setting, format), std::string{cull_names(setting.map.cull).gl},
             gl_offset(offset),
             reversed ? "glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);"
                      : "glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);",
             fmt::format("glDepthFunc({0}); glClearDepth({1}); // lookup compares with {2}",
                         reversed ? "GL_GREATER" : "GL_LESS", reversed ? 0 : 1,
                         reversed ? "GL_GEQUAL" : "GL_LEQUAL")}};
}

ApiState direct3d_state(const TunedSetting& setting, const Offset& offset)
{
    const std::string_view format = names_of(setting.map.depth_format).direct3d;
    if (format.empty()) {
        return {"Direct3D", {no_format(setting, "Direct3D")}};
    }
    const bool reversed = setting.map.frustum.reversed;
    ApiState state{
        "Direct3D",
        {fmt::format("{}_VIEW_DESC::Format = {};{}",
                     is_colour(setting) ? "D3D12_RENDER_TARGET" : "D3D12_DEPTH_STENCIL", format,
                     direct3d_maps(setting)),
         fmt::format("D3D12_RASTERIZER_DESC: CullMode = {}, FrontCounterClockwise = TRUE, "
                     "{}, DepthClipEnable = TRUE;",
                     cull_names(setting.map.cull).direct3d, direct3d_offset(offset)),
         fmt::format("D3D12_DEPTH_STENCIL_DESC::DepthFunc = D3D12_COMPARISON_FUNC_{}; clear to "
                     "{}",
                     reversed ? "GREATER" : "LESS", reversed ? 0 : 1)}};
    if (!is_colour(setting)) {
        state.lines.push_back(
            fmt::format("D3D12_SAMPLER_DESC::ComparisonFunc = D3D12_COMPARISON_FUNC_{};",
                        reversed ? "GREATER_EQUAL" : "LESS_EQUAL"));
    }
    return state;
}

ApiState vulkan_state(const TunedSetting& setting, const Offset& offset)
{
    const std::string_view format = names_of(setting.map.depth_format).vulkan;
    if (format.empty()) {
        return {"Vulkan", {no_format(setting, "Vulkan")}};
    }
    const bool reversed = setting.map.frustum.reversed;
    ApiState state{
        "Vulkan",
        {fmt::format("VkImageCreateInfo::format = {};{}", format, vulkan_maps(setting)),
         fmt::format("VkPipelineRasterizationStateCreateInfo: cullMode = {}, frontFace = "
                     "VK_FRONT_FACE_COUNTER_CLOCKWISE, {}, "
                     "depthClampEnable = VK_FALSE;",
                     cull_names(setting.map.cull).vulkan, vulkan_offset(offset)),
         fmt::format("VkPipelineDepthStencilStateCreateInfo::depthCompareOp = "
                     "VK_COMPARE_OP_{}; clear to {}",
                     reversed ? "GREATER" : "LESS", reversed ? 0 : 1)}};
    if (!is_colour(setting)) {
        state.lines.push_back(fmt::format("VkSamplerCreateInfo::compareOp = VK_COMPARE_OP_{};",
                                          reversed ? "GREATER_OR_EQUAL" : "LESS_OR_EQUAL"));
    }
    return state;
}

/// "0.00028 + 0.0012 * length(cross(N, L)) / abs(dot(N, L))": the bias that a lookup subtracts from
/// the depth; may be empty.
std::string bias_sum(const TunedSetting& setting)
{
    const analysis::RoundedBias& constant = setting.bias.rounded;
    std::string sum;
    if (!constant.unit->is_depth() && constant.value != 0 && cascades_of(setting) > 0) {
        sum =
            fmt::format("{} / {}", shader_number(constant.value), constant.unit->shader_per_depth);
    } else if (constant.bias != 0) {
        sum = shader_number(constant.bias);
    }
    if (setting.slope != 0) {
        sum += (sum.empty() ? "" : " + ") + slope_term(setting.slope);
    }
    return sum;
}

/// The biases that the lookup shader applies, each with its line of code.
void add_bias(ApiState& state, const TunedSetting& setting,
              std::span<const std::string> other_biases)
{
    const bool is_hlsl = state.api == "Direct3D";
    const auto add = [&](const std::string& line) {
        state.lines.push_back(fmt::format("{} of the lookup: {}", is_hlsl ? "HLSL" : "GLSL", line));
    };
    if (setting.normal_texels != 0) {
        add(fmt::format(
            "{} p = position + {} * 2.0 * light_clip.w / ({}.0 * "
            "min(light_projection[0][0], abs(light_projection[1][1]))) * N; // look p up; N: "
            "the triangle's normal, towards the light",
            is_hlsl ? "float3" : "vec3", shader_number(setting.normal_texels),
            setting.map.resolution_texels));
    }
    const std::string sum = bias_sum(setting);
    if (!sum.empty()) {
        add(fmt::format(
            "float bias = {};{}", sum,
            setting.slope == 0 ? "" : " // N: the triangle's normal, L: to the light, both unit"));
    }
    const std::string depth =
        sum.empty() ? "r" : fmt::format("r {} bias", setting.map.frustum.reversed ? "+" : "-");
    add(fmt::format("{} // r: the receiver's depth in [0, 1]{}",
                    comparison(setting.map, setting.filter, depth,
                               is_hlsl ? ShaderLanguage::hlsl : ShaderLanguage::glsl),
                    sum.empty() ? ", without a bias" : ""));
    if (!other_biases.empty()) {
        add(fmt::format("// and the job's own {}", fmt::join(other_biases, ", ")));
    }
}

} // namespace

std::vector<ApiState> api_states(const TunedSetting& setting, const Offset& offset,
                                 std::span<const std::string> other_biases)
{
    std::vector<ApiState> states{gl_state(setting, offset), direct3d_state(setting, offset),
                                 vulkan_state(setting, offset)};
    for (ApiState& state : states) {
        add_shader(state, setting);
        if (has_key(setting, "bias.constant")) {
            add_bias(state, setting, other_biases);
        }
    }
    return states;
}

} // namespace gnomon::reports
