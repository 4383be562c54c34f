#include "raster_gl/glsl_snippets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::raster_gl {

namespace {

using methods::ActiveBias;
using methods::BiasPlace;

/// Calls of the terms for which `is_asked` holds, one a line.
template <typename Asks, typename Call>
std::string calls(std::span<const ActiveBias> biases, const Asks& is_asked, const Call& call)
{
    std::string text;
    for (const ActiveBias& bias : biases) {
        if (is_asked(*bias.term)) {
            text += fmt::format("    {}\n", call(bias.term->function));
        }
    }
    return text;
}

/// The bias that the curve varies, the first of its terms, and the sum of the others.
std::string curve_functions(std::span<const ActiveBias> biases)
{
    std::vector<std::string> terms;
    for (const ActiveBias& bias : biases) {
        if (methods::is_of_curve(*bias.term)) {
            terms.push_back(fmt::format("{}(receiver)", bias.term->function));
        }
    }
    const std::span<const std::string> all{terms};
    const auto function = [](std::string_view name, std::span<const std::string> sum) {
        return fmt::format(
            "float {}(Receiver receiver)\n{{\n    precise float bias = {};\n    return bias;\n}}\n",
            name, sum.empty() ? "0.0" : fmt::format("{}", fmt::join(sum, " + ")));
    };
    const std::size_t first = all.empty() ? 0 : 1;
    return function("varied_bias", all.first(first)) + function("added_bias", all.subspan(first));
}

/// Where a receiver is looked up in light clip, and by how much its point is moved for that.
std::string position_functions(std::span<const ActiveBias> biases)
{
    const auto moves = [](const methods::BiasTerm& term) {
        return term.place == BiasPlace::lookup_position;
    };
    const std::string positions = calls(biases, moves, [](std::string_view function) {
        return fmt::format("clip = clip + light_clip_from_world[map_index] * "
                           "vec4({}(receiver), 0.0);",
                           function);
    });
    const std::string offsets = calls(biases, moves, [](std::string_view function) {
        return fmt::format("offset = offset + {}(receiver);", function);
    });
    return fmt::format("vec4 moved_position(Receiver receiver)\n{{\n    {}vec4 clip = "
                       "receiver.clip;\n{}    return clip;\n}}\n"
                       "#if TELLS_TERMS\nvec3 offset_of_position(Receiver receiver)\n{{\n"
                       "    precise vec3 offset = vec3(0.0);\n{}    return offset;\n}}\n#endif\n",
                       positions.empty() ? "" : "precise ", positions, offsets);
}

} // namespace

std::string snippets_before_shader(std::string_view source, const methods::GlslSnippet& snippet,
                                   std::string_view biases)
{
    return fmt::format("#line 1 1\n{}{}#line 1 2\n{}#line 1 0\n", shader_source(source), biases,
                       snippet.glsl);
}

std::string bias_functions(std::span<const ActiveBias> biases)
{
    std::string text;
    int number = 4;
    for (const ActiveBias& bias : biases) {
        text += fmt::format("#line 1 {}\n{}", number++, bias.snippet.glsl);
    }
    text += fmt::format("#line 1 {}\n", number);
    text += curve_functions(biases);
    const auto moves_depth = [](const methods::BiasTerm& term) {
        return term.place == BiasPlace::receiver_depth && !methods::is_of_curve(term);
    };
    text += position_functions(biases);
    text += fmt::format("float moved_depth(Receiver receiver, float r)\n{{\n{}    return r;\n}}\n",
                        calls(biases, moves_depth, [](std::string_view function) {
                            return fmt::format("r = {}(receiver, r);", function);
                        }));
    const auto has_gradient = [](const methods::BiasTerm& term) {
        return term.place == BiasPlace::per_tap;
    };
    const std::string gradients = calls(biases, has_gradient, [](std::string_view function) {
        return fmt::format("gradient += {}(receiver);", function);
    });
    if (!gradients.empty()) {
        text += fmt::format("vec2 gradient_of_taps(Receiver receiver)\n{{\n    vec2 gradient = "
                            "vec2(0.0);\n{}    return gradient;\n}}\n",
                            gradients);
    }
    return text;
}

bool has_gradient_of_taps(std::span<const ActiveBias> biases)
{
    return std::ranges::any_of(
        biases, [](const ActiveBias& bias) { return bias.term->place == BiasPlace::per_tap; });
}

std::string program_key(std::string_view text, const Definitions& definitions)
{
    std::string key{text};
    for (const auto& [name, value] : definitions) {
        key += fmt::format(" {}={}", name, value);
    }
    return key;
}

void add_definitions(const methods::GlslSnippet& snippet, Definitions& definitions)
{
    for (const methods::Definition& definition : snippet.definitions) {
        definitions.emplace_back(definition.name, definition.value);
    }
}

void set_uniforms(const Program& program, const methods::GlslSnippet& snippet)
{
    for (const methods::Uniform& uniform : snippet.uniforms) {
        set_uniform(program, uniform.name.c_str(), uniform.values);
    }
}

} // namespace gnomon::raster_gl
