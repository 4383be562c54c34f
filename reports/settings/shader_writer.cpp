#include "reports/settings/shader_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <utility>

namespace gnomon::reports {
namespace {

struct Word {
    std::string_view glsl;
    std::string_view hlsl;
};

constexpr auto words = std::to_array<Word>({
    {"vec2", "float2"},
    {"vec3", "float3"},
    {"vec4", "float4"},
    {"dFdx", "ddx"},
    {"dFdy", "ddy"},
    {"mix", "lerp"},
});

bool is_of_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string in_hlsl(std::string_view line)
{
    std::string text;
    while (!line.empty()) {
        const auto end = std::ranges::find_if_not(line, is_of_word);
        const std::string_view word{line.begin(), end};
        const auto found = std::ranges::find(words, word, &Word::glsl);
        text += found == words.end() ? word : found->hlsl;
        line.remove_prefix(word.size());
        if (!line.empty()) {
            text += line.front();
            line.remove_prefix(1);
        }
    }
    return text;
}

} // namespace

void ShaderWriter::add(std::string_view line)
{
    lines_.push_back(is_hlsl() ? in_hlsl(line) : std::string{line});
}

std::string ShaderWriter::count() const
{
    return has_cascades() ? fmt::format("[{}]", maps_) : std::string{};
}

std::string ShaderWriter::clip_of(std::string_view point) const
{
    return is_hlsl() ? fmt::format("mul({}, vec4({}, 1.0))", matrix(), point)
                     : fmt::format("{} * vec4({}, 1.0)", matrix(), point);
}

std::string ShaderWriter::row(std::size_t i) const
{
    return is_hlsl() ? fmt::format("{}[{}].xyz", matrix(), i)
                     : fmt::format("vec3({0}[0].{1}, {0}[1].{1}, {0}[2].{1})", matrix(),
                                   std::string_view{"xyzw"}.at(i));
}

std::string ShaderWriter::texel_at_tap() const
{
    if (is_hlsl()) {
        return has_cascades() ? "shadow_map.Load(int4(int2(tap), cascade, 0))"
                              : "shadow_map.Load(int3(int2(tap), 0))";
    }
    return has_cascades() ? "texelFetch(shadow_map, ivec3(ivec2(tap), cascade), 0).r"
                          : "texelFetch(shadow_map, ivec2(tap), 0).r";
}

void ShaderWriter::add_array(std::string_view name, const std::vector<float>& values)
{
    std::vector<std::string> numbers;
    std::ranges::transform(values, std::back_inserter(numbers),
                           [](float value) { return shader_number(value); });
    add(is_hlsl() ? fmt::format("    static const float {}[{}] = {{{}}};", name, values.size(),
                                fmt::join(numbers, ", "))
                  : fmt::format("    const float {0}[{1}] = float[{1}]({2});", name, values.size(),
                                fmt::join(numbers, ", ")));
}

std::string ShaderWriter::by_map(std::string_view name, const std::vector<float>& values)
{
    if (std::ranges::all_of(values, [&](float value) { return value == values.front(); })) {
        return shader_number(values.front());
    }
    add_array(name, values);
    return fmt::format("{}[cascade]", name);
}

std::vector<std::string> ShaderWriter::take_lines()
{
    return std::exchange(lines_, {});
}

void add_plane_rise(ShaderWriter& out, std::string_view resolution, bool is_reversed)
{
    // The map is half as wide as clip space, and GL's also half as deep. Direct3D's rows run down.
    const std::string_view scale = out.is_hlsl() ? "vec2(2.0, -2.0) * "
                                   : is_reversed ? "2.0 * "
                                                 : "";
    out.add("");
    out.add("// The change of depth from texel to texel along the receiver's plane.");
    out.add(fmt::format("vec2 plane_rise(vec3 position, vec3 N{})", out.parameter()));
    out.add("{");
    out.add(fmt::format("    vec4 clip = {};", out.clip_of("position")));
    out.add("    vec3 ndc = clip.xyz / clip.w;");
    out.add(fmt::format("    vec3 w = {};", out.row(3)));
    out.add(fmt::format("    vec3 x = {} - ndc.x * w;", out.row(0)));
    out.add(fmt::format("    vec3 y = {} - ndc.y * w;", out.row(1)));
    out.add(fmt::format("    vec3 z = {} - ndc.z * w;", out.row(2)));
    out.add(fmt::format("    float facing = {} * dot(N, cross(x, y));", resolution));
    out.add("    vec2 rise = vec2(dot(N, cross(y, z)), dot(N, cross(z, x))) / -facing;");
    out.add(fmt::format("    return facing == 0.0 ? vec2(0.0, 0.0) : {}rise;", scale));
    out.add("}");
}

void add_derived_rise(ShaderWriter& out, std::string_view resolution, bool is_reversed)
{
    const std::string_view depth = out.is_hlsl() || is_reversed ? "1.0" : "0.5";
    out.add("");
    out.add("// The change of depth from texel to texel, by the neighbouring pixels.");
    out.add(fmt::format("vec2 derived_rise(vec3 position{})", out.parameter()));
    out.add("{");
    out.add(fmt::format("    vec4 clip = {};", out.clip_of("position")));
    out.add(fmt::format("    vec3 here = clip.xyz / clip.w * vec3(0.5 * {0}, {1}0.5 * {0}, {2});",
                        resolution, out.is_hlsl() ? "-" : "", depth));
    out.add("    vec3 dx = dFdx(here);");
    out.add("    vec3 dy = dFdy(here);");
    out.add("    float area = dx.x * dy.y - dx.y * dy.x;");
    out.add("    vec2 rise = vec2(dy.y * dx.z - dx.y * dy.z, dx.x * dy.z - dy.x * dx.z) / area;");
    out.add("    return area == 0.0 ? vec2(0.0, 0.0) : rise;");
    out.add("}");
}

void add_tap_visibility(ShaderWriter& out, int resolution_texels, scene::Outside outside,
                        bool is_reversed)
{
    out.add("");
    out.add(fmt::format("float tap_visibility(vec2 tap, float depth{})", out.parameter()));
    out.add("{");
    if (outside == scene::Outside::clamp) {
        out.add(fmt::format("    tap = clamp(tap, vec2(0.0, 0.0), vec2({0}, {0}));",
                            shader_number(resolution_texels - 1.0)));
    } else {
        out.add(
            fmt::format("    if (tap.x < 0.0 || tap.y < 0.0 || tap.x >= {0} || tap.y >= {0}) {{",
                        shader_number(1.0 * resolution_texels)));
        out.add(
            fmt::format("        return {};", outside == scene::Outside::shadowed ? "0.0" : "1.0"));
        out.add("    }");
    }
    out.add(fmt::format("    return depth {} {} ? 1.0 : 0.0;",
                        is_reversed ? ">=" : "<=", out.texel_at_tap()));
    out.add("}");
}

} // namespace gnomon::reports
