#pragma once

#include "scene/job/presets/engine.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"
#include "scene/light/light.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Where a preset's numbers come from.
enum class PresetKind : std::uint8_t {
    lesson, ///< a document that teaches shadow maps
    engine, ///< a renderer's defaults
};

/// "lesson", "engine".
[[nodiscard]] std::string_view preset_kind_name(PresetKind kind);

/// The shadow map of a lesson or an engine as settings of a job: a file NAME.toml in this folder.
struct Preset {
    std::string name;
    PresetKind kind = PresetKind::lesson;
    std::string sentence;            ///< what it is, on one line
    std::string source;              ///< document, or engine, version and file
    std::vector<LightType> lights;   ///< types of light that it supports
    std::string own_bias;            ///< its bias, in the source's own words and units
    std::vector<std::string> cannot; ///< features that a job cannot express
    Layer job;                       ///< keys of method, map, lookup and bias
    std::optional<Engine> engine;    ///< how its users set it; empty for a lesson
    Layer own_scene; ///< keys of its scene, camera, light and map placement; may be empty

    [[nodiscard]] bool is_for(LightType type) const;
};

/// All presets, lessons first, with keys of this table.
[[nodiscard]] std::vector<Preset> presets(const KeyTable& keys);

/// The names of the presets with an engine, in the order of their list. Reads no preset.
[[nodiscard]] std::vector<std::string> engine_names();

/// The preset of an engine.
/// @param name   its name or an alias, in upper or lower case.
/// @param label  how the message names the choice: "--engine thre".
/// @param more   further names that the caller takes, for the message.
/// @throws InputError  naming the nearest engine and all others, if none has that name.
[[nodiscard]] Preset find_engine(const KeyTable& keys, std::string_view name,
                                 std::string_view label,
                                 std::span<const std::string_view> more = {});

/// @param label  how the message names the choice: "--preset beby".
/// @throws InputError  naming the nearest preset, if none has that name.
[[nodiscard]] Preset find_preset(const KeyTable& keys, std::string_view name,
                                 std::string_view label);

/// Reads a preset from the text of its file.
/// @param base  the preset that it is based on, or nullptr.
/// @throws InputError  if a member is missing or unknown, or a key does not accept its value.
[[nodiscard]] Preset read_preset(const KeyTable& keys, std::string_view name, std::string_view text,
                                 const Preset* base = nullptr);

/// The name of the preset that this one is based on; may be empty.
/// @throws InputError  as `read_preset`.
[[nodiscard]] std::string base_of_preset(std::string_view name, std::string_view text);

/// Whether presets decide this key: method, lookup, bias and all of the map but its placement. Keys
/// that a preset omits are at their defaults.
[[nodiscard]] bool is_system_key(std::string_view key);

/// A preset's file.
struct PresetFile {
    std::string_view name; ///< "bevy.toml"
    std::string_view text;
};
[[nodiscard]] std::span<const PresetFile> preset_files();

struct Preset;

/// A preset that was chosen.
struct ChosenPreset {
    std::shared_ptr<const Preset> preset = nullptr; ///< may be nullptr
    std::string label;                              ///< how messages name the choice
};

/// The preset of `--preset NAME`; no preset if the name is empty.
/// @throws InputError  naming the nearest, if no preset has that name.
[[nodiscard]] ChosenPreset choose_preset(const KeyTable& keys, std::string_view name);

/// The preset of `preset = "NAME"` in a file.
/// @throws InputError  as `choose_preset`, and if the value is not a text.
[[nodiscard]] ChosenPreset read_preset_choice(const KeyTable& keys, const TomlMember& member,
                                              const std::string& file);

/// The preset's layers, the weakest first: its settings for any job, then its own scene unless
/// `given` names one.
/// @param given       Settings that are laid over it.
/// @param has_lights  Whether the job defines several lights, even if only one was chosen.
[[nodiscard]] std::vector<Layer> preset_layers(const Preset* preset, const Settings& given,
                                               bool has_lights);

/// Refuses a preset that does not support the settings' type of light.
/// @throws InputError  naming the choice.
void check_preset_light(const ChosenPreset& chosen, const Settings& settings);

/// The layer without the keys that a preset decides as a whole (`is_system_key`).
[[nodiscard]] Layer without_system_keys(Layer layer);

} // namespace gnomon::scene
