#pragma once

#include "scene/builtin/builtin_scene.hpp"

#include <span>
#include <string_view>

namespace gnomon::scene {

/// All built-in scenes, in the order in which `gnomon scenes` lists them.
[[nodiscard]] std::span<const BuiltinScene> builtin_scenes();

/// @throws InputError  naming the nearest name, if no built-in scene has this one.
[[nodiscard]] const BuiltinScene& find_builtin_scene(std::string_view name);

/// The parameters' defaults with `given` laid over them.
/// @throws InputError  naming key, value and range (or the nearest key), if a value is not allowed.
[[nodiscard]] ParameterValues complete_parameters(const BuiltinScene& scene,
                                                  const ParameterValues& given);

} // namespace gnomon::scene
