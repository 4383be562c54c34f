#pragma once

#include "scene/job/presets/engine.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/light/light.hpp"

#include <cstdint>
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

/// The shadow map of a lesson or an engine, in the terms of a job: a file NAME.toml beside this
/// one.
struct Preset {
    std::string name;
    PresetKind kind = PresetKind::lesson;
    std::string sentence;            ///< what it is, on one line
    std::string source;              ///< document, or engine, version and file
    std::vector<LightType> lights;   ///< whose jobs it can be laid under
    std::string own_bias;            ///< its bias in its own words and units
    std::vector<std::string> cannot; ///< what a job cannot express of it
    Layer job;                       ///< keys of method, map, lookup and bias, under any job
    std::optional<Engine> engine;    ///< how its users set it; empty of a lesson
    Layer own_scene; ///< keys of its scene, camera and light, and where its map looks; may be empty

    [[nodiscard]] bool is_for(LightType type) const;
};

/// All of them, lessons first, in terms of a table's keys.
[[nodiscard]] std::vector<Preset> presets(const KeyTable& keys);

/// The names of those with an engine, as the sources list them. Reads no preset.
[[nodiscard]] std::vector<std::string> engine_names();

/// @param label  how the message speaks of the choice: "--preset beby".
/// @throws InputError  naming the nearest name, if there is none of that name.
[[nodiscard]] Preset find_preset(const KeyTable& keys, std::string_view name,
                                 std::string_view label);

/// A preset from the text of its file.
/// @param base  whose keys its own are laid over; nullptr for none.
/// @throws InputError  if a member is missing or unknown, or a key does not accept its value.
[[nodiscard]] Preset read_preset(const KeyTable& keys, std::string_view name, std::string_view text,
                                 const Preset* base = nullptr);

/// The name that a preset's text says it is based on; empty: none.
/// @throws InputError  as `read_preset`.
[[nodiscard]] std::string base_of_preset(std::string_view name, std::string_view text);

/// Whether a key is one of those that a preset decides as a whole, and what it leaves out is at its
/// default: method, lookup and bias, and of the map all but where it looks.
[[nodiscard]] bool is_system_key(std::string_view key);

/// A preset's file, as it is in the source.
struct PresetFile {
    std::string_view name; ///< "bevy.toml"
    std::string_view text;
};
[[nodiscard]] std::span<const PresetFile> preset_files();

} // namespace gnomon::scene
