#pragma once

#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// What becomes of a preset in a job's source.
namespace gnomon::scene {

struct Preset;

/// A preset that was chosen.
struct ChosenPreset {
    std::shared_ptr<const Preset> preset = nullptr; ///< nullptr: none is
    std::string label;                              ///< how messages speak of the choice
};

/// The preset of `--preset NAME`; none of an empty name.
/// @throws InputError  naming the nearest, if there is none of that name.
[[nodiscard]] ChosenPreset choose_preset(const KeyTable& keys, std::string_view name);

/// The preset of `preset = "NAME"` in a file.
/// @throws InputError  the same, and if it is no text.
[[nodiscard]] ChosenPreset read_preset_choice(const KeyTable& keys, const TomlMember& member,
                                              const std::string& file);

/// What a preset says, the weakest first: of any job, then, where nothing that is given names a
/// scene, with its own.
/// @param given       What is laid over it.
/// @param has_lights  Whether the job has several lights: they are its own, also where one of them
///                    was chosen.
[[nodiscard]] std::vector<Layer> preset_layers(const Preset* preset, const Settings& given,
                                               bool has_lights);

/// Refuses a preset for another kind of light than the settings have.
/// @throws InputError  naming the choice.
void check_preset_light(const ChosenPreset& chosen, const Settings& settings);

/// The layer without the keys that a preset decides as a whole (`is_system_key`).
[[nodiscard]] Layer without_system_keys(Layer layer);

} // namespace gnomon::scene
