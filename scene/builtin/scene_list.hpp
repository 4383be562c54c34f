#pragma once

#include "scene/builtin/builtin_scene.hpp"
#include "scene/builtin/objects.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The built-in scenes, by the file that generates them.
// closed_forms.cpp
[[nodiscard]] BuiltinScene tilted_plane_scene();
[[nodiscard]] BuiltinScene wall_scene();
[[nodiscard]] BuiltinScene room_scene();
[[nodiscard]] BuiltinScene fence_scene();
// columns.cpp
[[nodiscard]] BuiltinScene columns_scene();
// indoors.cpp
[[nodiscard]] BuiltinScene lamp_room_scene();
// large_scenes.cpp
[[nodiscard]] BuiltinScene terrain_scene();
[[nodiscard]] BuiltinScene sphere_field_scene();
// lessons.cpp
[[nodiscard]] BuiltinScene sphere_cube_scene();
[[nodiscard]] BuiltinScene sphere_plane_scene();
[[nodiscard]] BuiltinScene two_distances_scene();
// outdoors.cpp
[[nodiscard]] BuiltinScene yard_scene();
[[nodiscard]] BuiltinScene playground_scene();

/// An inclusive range of a numeric parameter.
struct ParameterRange {
    double lower = 0;
    double upper = 0;
};

[[nodiscard]] BuiltinParameter number_parameter(std::string name, std::string description,
                                                std::string unit, double default_value,
                                                ParameterRange range);
[[nodiscard]] BuiltinParameter count_parameter(std::string name, std::string description,
                                               double default_value, ParameterRange range);
/// A parameter that is one of `words`; the first is the default.
[[nodiscard]] BuiltinParameter word_parameter(std::string name, std::string description,
                                              std::vector<std::string> words);

/// The value of a parameter, after `complete_parameters`.
/// @throws std::out_of_range  if it is not among the values.
[[nodiscard]] double number(const ParameterValues& values, const std::string& name);
[[nodiscard]] int count(const ParameterValues& values, const std::string& name);
[[nodiscard]] const std::string& word(const ParameterValues& values, const std::string& name);

/// A default job for the built-in scene of that name.
[[nodiscard]] Job start_job(std::string_view name, const ParameterValues& values);

/// @param direction  The direction in which the light travels.
[[nodiscard]] LightSettings directional_light(const Vec3d& direction);
/// @param cone_deg  Full opening angle; (0, 180).
[[nodiscard]] LightSettings spot_light(const Vec3d& position, const Vec3d& target, double cone_deg);

/// The direction in which sunlight travels, as a unit vector.
/// @param elevation_deg  Height of the sun above the horizon; (0, 90).
/// @param azimuth_deg    Where the sun stands, from +z towards +x.
[[nodiscard]] Vec3d sunlight_direction(double elevation_deg, double azimuth_deg);

/// Adds one mesh as one object.
void add_object(SceneBuilder& builder, std::string_view name, const Mesh& mesh);

} // namespace gnomon::scene
