#include "reports/tune/shader_lines.hpp"

#include <fmt/format.h>

#include <string_view>

namespace gnomon::reports {
namespace {

std::string with_point(std::string text)
{
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

} // namespace

std::string shader_number(double value)
{
    return with_point(fmt::format("{}", value));
}

std::string shader_number(float value)
{
    return with_point(fmt::format("{}", value));
}

std::string slope_term(double slope)
{
    return fmt::format("{} * length(cross(N, L)) / abs(dot(N, L))", shader_number(slope));
}

std::string comparison(const scene::ShadowMapSettings& map, scene::Filter filter,
                       const std::string& depth, ShaderLanguage language)
{
    const bool is_hlsl = language == ShaderLanguage::hlsl;
    const bool is_cube = map.layout == scene::MapLayout::cube;
    const bool is_layered = map.layout == scene::MapLayout::cascades;
    const std::string_view place = is_cube       ? "direction"
                                   : !is_layered ? "uv"
                                   : is_hlsl     ? "float3(uv, cascade)"
                                                 : "vec3(uv, cascade)";
    if (traits_of(map.depth_format).is_colour || filter == scene::Filter::linear) {
        return fmt::format("lit = {} {} {};", depth, map.frustum.reversed ? ">=" : "<=",
                           is_hlsl ? fmt::format("shadow_map.Sample(shadow_sampler, {}).r", place)
                                   : fmt::format("texture(shadow_map, {}).r", place));
    }
    if (is_hlsl) {
        return fmt::format("lit = shadow_map.SampleCmpLevelZero(shadow_sampler, {}, {});", place,
                           depth);
    }
    return fmt::format("lit = texture(shadow_map, {}({}, {}));",
                       is_cube || is_layered ? "vec4" : "vec3", is_layered ? "uv, cascade" : place,
                       depth);
}

} // namespace gnomon::reports
