#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/written_key.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/toml.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// A key with a valid value, and its label in messages: "job.toml:3: bias.slope = 0.5".
struct Setting {
    const Key* spec = nullptr;
    JobValue value;
    std::string label;
    std::string light = {}; ///< one of several; empty: all lights

    [[nodiscard]] WrittenKey key() const { return {spec, light}; }
};

/// The settings from one source: a built-in's defaults, a file, a case, or the overrides.
using Layer = std::vector<Setting>;

/// The method that a layer sets, for all lights or for one; nullptr if it sets none.
[[nodiscard]] const std::string* method_of(const Layer& layer, std::string_view light = {});

/// Removes settings that jobs of the method do not have.
void drop_keys_of_other_methods(Layer& layer, std::string_view method);

/// The part of a layer that applies to one light, as a job with only that light would give it:
/// settings for all lights that this light's method has, then settings for this light.
[[nodiscard]] Layer layer_of_light(const Layer& layer, std::string_view light);

/// A `[[case]]`: its name and the settings that override the file's.
struct CaseLayer {
    std::string name;
    Layer layer;
};

/// The final settings after all layers, by key.
using Settings = std::map<std::string, Setting, std::less<>>;

/// A key's position in the job file, for messages.
struct KeyPlace {
    std::string file;
    std::uint32_t line = 0;

    /// "job.toml:3: ", to begin a message.
    [[nodiscard]] std::string text() const;
};

/// @throws InputError  "label: must be …", if the key does not accept the node.
[[nodiscard]] Setting make_setting(const WrittenKey& key, const TomlNode& node, std::string label);

using KeyVisitor = std::function<void(const WrittenKey&, const TomlNode&, const KeyPlace&)>;

/// Calls `visit` for each known key in a table, which may be nested, dotted or both.
/// @param siblings  Other allowed names, also suggested as the nearest.
/// @throws InputError  for an unknown key, naming the nearest, and for a table's name with a value.
void for_each_key(const KeyTable& keys, const TomlTable& table, const std::string& file,
                  const std::vector<std::string>& siblings, const KeyVisitor& visit);

/// The settings in the table of a job file or a case.
/// @param heading  text that messages put before the key; may be empty, e.g. "[[case]] \"noon\": ".
/// @throws InputError  as `for_each_key` and `make_setting`, and if a key is given twice.
[[nodiscard]] Layer layer_from_table(const KeyTable& keys, const TomlTable& table,
                                     const std::string& file, const std::string& heading,
                                     const std::vector<std::string>& siblings);

/// The `[[case]]` tables of a job file.
/// @throws InputError  if a case has no name, a name repeats, or a key does not accept its value.
[[nodiscard]] std::vector<CaseLayer> read_cases(const KeyTable& keys, const TomlMember& member,
                                                const std::string& file);

/// The settings of `--set key=value` arguments; the last one for a key counts.
/// @throws InputError  naming the argument.
[[nodiscard]] Layer layer_from_overrides(const KeyTable& keys,
                                         const std::vector<Override>& overrides);

/// The settings of all keys that are not at their defaults, in the order of the job's key table.
/// @param builtin  The built-in scene whose default job this is, for messages.
[[nodiscard]] Layer layer_from_job(const Job& job, std::string_view builtin);

/// Lays a layer over the settings. A key also replaces keys that it excludes: light.type =
/// "directional" removes a cone from below.
void lay_over(Settings& settings, const Layer& layer);

/// Merges layers, the weakest first. The strongest layer that sets the method decides: weaker
/// layers lose the settings that this method does not have.
[[nodiscard]] Settings lay_all(std::vector<Layer> layers);

/// Checks settings against each other: mutually exclusive keys, required keys, near and far, …
/// @param source  Named in the message when a key is missing.
/// @throws InputError  naming the keys and what to do.
void check_settings(const KeyTable& keys, const Settings& settings, const std::string& source);
/// The part of `check_settings` about cascades.
void check_cascades(const Settings& settings);

/// The part of `check_settings` about the choice of the scene.
void check_scene_choice(const KeyTable& keys, const Settings& settings, const std::string& source);

/// Reports an invalid setting.
/// @throws InputError  always: "label: why".
[[noreturn]] void refuse(const Setting& setting, std::string_view why);

/// The setting of that key, or nullptr.
[[nodiscard]] inline const Setting* find_setting(const Settings& settings, std::string_view key)
{
    const auto found = settings.find(key);
    return found == settings.end() ? nullptr : &found->second;
}

} // namespace gnomon::scene
