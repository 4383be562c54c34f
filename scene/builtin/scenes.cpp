#include "scene/builtin/scenes.hpp"

#include "scene/builtin/scene_list.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace gnomon::scene {

std::span<const BuiltinScene> builtin_scenes()
{
    static const std::array<BuiltinScene, 13> scenes{
        sphere_cube_scene(),   sphere_plane_scene(), yard_scene(),    playground_scene(),
        two_distances_scene(), tilted_plane_scene(), wall_scene(),    room_scene(),
        lamp_room_scene(),     fence_scene(),        terrain_scene(), columns_scene(),
        sphere_field_scene()};
    return scenes;
}

const BuiltinScene& find_builtin_scene(std::string_view name)
{
    const auto scenes = builtin_scenes();
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const BuiltinScene& scene) { return scene.name == name; });
    if (found == scenes.end()) {
        std::vector<std::string> names;
        for (const BuiltinScene& scene : scenes) {
            names.push_back(scene.name);
        }
        throw InputError{fmt::format("scene.builtin = \"{}\": there is no such built-in scene; the "
                                     "nearest is \"{}\" (`gnomon scenes` lists them)",
                                     name, nearest_word(name, names))};
    }
    return *found;
}

namespace {

[[nodiscard]] std::string allowed_text(const BuiltinParameter& parameter)
{
    if (!parameter.words.empty()) {
        return fmt::format("allowed is \"{}\"", fmt::join(parameter.words, "\" or \""));
    }
    return fmt::format("allowed is {} from {} to {}{}{}",
                       parameter.is_integer ? "an integer" : "a number", parameter.lower,
                       parameter.upper, parameter.unit.empty() ? "" : " ", parameter.unit);
}

[[nodiscard]] bool is_allowed(const BuiltinParameter& parameter, const SceneParameter& value)
{
    if (!parameter.words.empty()) {
        const auto* text = std::get_if<std::string>(&value);
        return text != nullptr && std::find(parameter.words.begin(), parameter.words.end(),
                                            *text) != parameter.words.end();
    }
    const auto* x = std::get_if<double>(&value);
    // NaN fails the comparisons.
    return x != nullptr && *x >= parameter.lower && *x <= parameter.upper &&
           (!parameter.is_integer || std::floor(*x) == *x);
}

[[nodiscard]] std::string value_text(const SceneParameter& value)
{
    if (const auto* x = std::get_if<double>(&value)) {
        return fmt::format("{}", *x);
    }
    return fmt::format("\"{}\"", std::get<std::string>(value));
}

[[nodiscard]] std::string unknown_parameter_text(const BuiltinScene& scene, const std::string& name)
{
    const std::string key = fmt::format("scene.{}.{}", scene.name, name);
    if (scene.parameters.empty()) {
        return fmt::format("{}: the scene {} has no parameters; remove the key", key, scene.name);
    }
    std::vector<std::string> names;
    for (const BuiltinParameter& parameter : scene.parameters) {
        names.push_back(parameter.name);
    }
    return fmt::format("{}: the scene {} has no such parameter; the nearest is \"{}\"", key,
                       scene.name, nearest_word(name, names));
}

} // namespace

ParameterValues complete_parameters(const BuiltinScene& scene, const ParameterValues& given)
{
    ParameterValues values;
    for (const BuiltinParameter& parameter : scene.parameters) {
        values.emplace(parameter.name, parameter.default_value);
    }
    for (const auto& [name, value] : given) {
        const auto parameter =
            std::find_if(scene.parameters.begin(), scene.parameters.end(),
                         [&](const BuiltinParameter& p) { return p.name == name; });
        if (parameter == scene.parameters.end()) {
            throw InputError{unknown_parameter_text(scene, name)};
        }
        if (!is_allowed(*parameter, value)) {
            throw InputError{fmt::format("scene.{}.{} = {}: {}", scene.name, name,
                                         value_text(value), allowed_text(*parameter))};
        }
        values[name] = value;
    }
    return values;
}

BuiltinParameter number_parameter(std::string name, std::string description, std::string unit,
                                  double default_value, ParameterRange range)
{
    return {.name = std::move(name),
            .description = std::move(description),
            .unit = std::move(unit),
            .default_value = default_value,
            .lower = range.lower,
            .upper = range.upper,
            .is_integer = false,
            .words = {}};
}

BuiltinParameter count_parameter(std::string name, std::string description, double default_value,
                                 ParameterRange range)
{
    BuiltinParameter parameter =
        number_parameter(std::move(name), std::move(description), "", default_value, range);
    parameter.is_integer = true;
    return parameter;
}

BuiltinParameter word_parameter(std::string name, std::string description,
                                std::vector<std::string> words)
{
    return {.name = std::move(name),
            .description = std::move(description),
            .unit = "",
            .default_value = words.front(),
            .lower = 0,
            .upper = 0,
            .is_integer = false,
            .words = words};
}

double number(const ParameterValues& values, const std::string& name)
{
    return std::get<double>(values.at(name));
}

int count(const ParameterValues& values, const std::string& name)
{
    return static_cast<int>(number(values, name));
}

const std::string& word(const ParameterValues& values, const std::string& name)
{
    return std::get<std::string>(values.at(name));
}

Job start_job(std::string_view name, const ParameterValues& values)
{
    Job job;
    job.scene.builtin = name;
    job.scene.parameters = values;
    return job;
}

LightSettings directional_light(const Vec3d& direction)
{
    LightSettings light;
    light.direction = direction;
    return light;
}

LightSettings spot_light(const Vec3d& position, const Vec3d& target, double cone_deg)
{
    LightSettings light;
    light.type = LightType::spot;
    light.position = position;
    light.target = target;
    light.cone_deg = cone_deg;
    return light;
}

Vec3d sunlight_direction(double elevation_deg, double azimuth_deg)
{
    const double elevation_rad = elevation_deg * std::numbers::pi / 180;
    const double azimuth_rad = azimuth_deg * std::numbers::pi / 180;
    return {-std::cos(elevation_rad) * std::sin(azimuth_rad), -std::sin(elevation_rad),
            -std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

void add_object(SceneBuilder& builder, std::string_view name, const Mesh& mesh)
{
    builder.add(name, mesh.vertices, mesh.triangles);
}

} // namespace gnomon::scene
