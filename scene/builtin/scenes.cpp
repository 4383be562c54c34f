#include "scene/builtin/scenes.hpp"

#include "scene/builtin/scene_list.hpp"
#include "scene/error.hpp"
#include "scene/nearest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

} // namespace gnomon::scene
