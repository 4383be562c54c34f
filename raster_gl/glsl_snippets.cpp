#include "raster_gl/glsl_snippets.hpp"

#include "methods/taps/tap_kernel.hpp"
#include "scene/light/cube_faces.hpp"
#include "scene/light/frustum.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::raster_gl {

namespace {

using methods::ActiveBias;
using methods::BiasPlace;

/// Calls of the terms for which `is_asked` holds, one per line.
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

/// The functions for the bias that a curve varies (its first term) and for the sum of the others.
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

/// The functions for a receiver's lookup position in light clip space, and for how far its point
/// moves.
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
                       "#if WRITES_TERMS\nvec3 offset_of_position(Receiver receiver)\n{{\n"
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

namespace {

/// The light's position, or the direction towards a directional light.
scene::Vec3f light_uniform(const scene::Light& light)
{
    return light.has_position() ? scene::Vec3f{light.position}
                                : scene::Vec3f{-glm::normalize(light.direction)};
}

std::vector<scene::Mat4f> matrices_of(const scene::View& view)
{
    std::vector<scene::Mat4f> matrices;
    for (const scene::LightFrustum& map : view.maps) {
        matrices.push_back(map.light_clip_from_world);
    }
    return matrices;
}

std::string face_table(std::string_view name, scene::WorldAxis scene::CubeFace::*axis)
{
    std::vector<std::string> vectors;
    for (const scene::CubeFace& face : scene::cube_faces) {
        vectors.push_back(fmt::format("ivec3({})", fmt::join(face.*axis, ", ")));
    }
    return fmt::format("const ivec3 {}[6] = ivec3[6]({});\n", name, fmt::join(vectors, ", "));
}

std::string face_tables()
{
    return face_table("face_forward", &scene::CubeFace::forward) +
           face_table("face_right", &scene::CubeFace::right) +
           face_table("face_up", &scene::CubeFace::up);
}

std::vector<float> coordinates(std::span<const scene::Vec2f> vectors)
{
    std::vector<float> all;
    for (const scene::Vec2f& vector : vectors) {
        all.insert(all.end(), {vector.x, vector.y});
    }
    return all;
}

} // namespace

std::string scattered_taps_source(const methods::ScatteredTaps& taps)
{
    return taps.places.empty() ? std::string{}
                               : fmt::format("#line 1 9\n{}", shader_source("scattered_taps.glsl"));
}

void add_definitions(const methods::ScatteredTaps& taps, Definitions& definitions)
{
    const bool is_scattered = !taps.places.empty();
    const auto flag = [](bool on) { return on ? "1" : "0"; };
    definitions.emplace_back("SCATTERED", flag(is_scattered));
    if (is_scattered) {
        definitions.emplace_back("TAPS", std::to_string(taps.places.size()));
        definitions.emplace_back("RADIUS_IN_METRES", flag(taps.is_in_metres));
        definitions.emplace_back("TURNED", flag(taps.is_turned));
        definitions.emplace_back("ROTATIONS", std::to_string(methods::rotation_count));
    }
}

void set_uniforms(const Program& lookup, const methods::ScatteredTaps& taps,
                  const scene::View& view, int resolution_texels)
{
    if (taps.places.empty()) {
        return;
    }
    std::vector<float> widths_m;
    for (const scene::LightFrustum& map : view.maps) {
        widths_m.push_back(static_cast<float>(map.texel_width_m(1.0, resolution_texels)));
    }
    set_uniform(lookup, "tap_places", coordinates(taps.places));
    set_uniform(lookup, "kernel_radius", static_cast<float>(taps.radius));
    set_uniform(lookup, "rotations", coordinates(methods::rotations()));
    set_uniform(lookup, "texel_width_m", widths_m);
    set_uniform(lookup, "largest_radius", static_cast<float>(methods::largest_radius_texels));
}

std::string map_choice(const scene::View& view)
{
    if (view.maps.size() == 1) {
        return {};
    }
    const auto source = [](std::string_view name) {
        return fmt::format("#line 1 3\n{}", shader_source(name));
    };
    switch (view.map_choice) {
    case scene::MapChoice::containing:
        return source("map_choice.glsl");
    case scene::MapChoice::cube_face:
        return face_tables() + source("cube_faces.glsl");
    case scene::MapChoice::view_depth:
        return source("view_slices.glsl");
    }
    return {};
}

void set_uniforms(const Program& lookup, const scene::View& view)
{
    const scene::LightFrustum& first = view.first_map();
    const scene::Vec2d depth_row = clip_depth_row(first.depth_range());
    set_uniform(lookup, "light_clip_from_world", matrices_of(view));
    set_uniform(lookup, "light", light_uniform(view.light));
    set_uniform(lookup, "origin", static_cast<float>(first.stored_range().near_m));
    set_uniform(lookup, "far", static_cast<float>(first.far_m));
    set_uniform(lookup, "half_side",
                std::array{static_cast<float>(first.right_side), static_cast<float>(first.top)});
    set_uniform(lookup, "clip_depth_row",
                std::array{static_cast<float>(depth_row.x), static_cast<float>(depth_row.y)});
    set_uniform(lookup, "bias_scale", view.bias_scales);
    set_uniform(lookup, "view_eye", view.slices.eye);
    set_uniform(lookup, "view_forward", view.slices.forward);
    set_uniform(lookup, "slice_ends", view.slices.ends);
    set_uniform(lookup, "mixed_from", view.slices.mixed_from);
}

} // namespace gnomon::raster_gl
