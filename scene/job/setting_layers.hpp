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

/// A key with an accepted value, and how messages speak of it: "job.toml:3: bias.slope = 0.5".
struct Setting {
    const Key* spec = nullptr;
    JobValue value;
    std::string label;
    std::string light = {}; ///< of one of several; empty: of all lights

    [[nodiscard]] WrittenKey key() const { return {spec, light}; }
};

/// What one source says: a built-in's defaults, a file, a case, or the overrides.
using Layer = std::vector<Setting>;

/// The method that a layer names, of all lights or of one of several; nullptr where it names none.
[[nodiscard]] const std::string* method_of(const Layer& layer, std::string_view light = {});

/// Leaves away what jobs of the method have no key for.
void drop_keys_of_other_methods(Layer& layer, std::string_view method);

/// Of a layer what holds for one of several lights, as a job with that light alone would say it:
/// what is said of all lights, as far as this one's own method has the keys, then what is said of
/// this one.
[[nodiscard]] Layer layer_of_light(const Layer& layer, std::string_view light);

/// A `[[case]]`: its name and the keys that it lays over the file's.
struct CaseLayer {
    std::string name;
    Layer layer;
};

/// What holds after all layers, by key.
using Settings = std::map<std::string, Setting, std::less<>>;

/// Where in the job file a key stands, for messages.
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
/// @param siblings  What else may stand beside the keys, to be named when it is the nearest.
/// @throws InputError  for an unknown key, naming the nearest, and for a table's name with a value.
void for_each_key(const KeyTable& keys, const TomlTable& table, const std::string& file,
                  const std::vector<std::string>& siblings, const KeyVisitor& visit);

/// The settings of a job file's table, or of a case's.
/// @param heading  "" or what messages put before the key, e.g. "[[case]] \"noon\": ".
/// @throws InputError  as `for_each_key` and `make_setting`, and for a key that is given twice.
[[nodiscard]] Layer layer_from_table(const KeyTable& keys, const TomlTable& table,
                                     const std::string& file, const std::string& heading,
                                     const std::vector<std::string>& siblings);

/// The settings of `--set key=value` arguments; the last one of a key counts.
/// @throws InputError  naming the argument.
[[nodiscard]] Layer layer_from_overrides(const KeyTable& keys,
                                         const std::vector<Override>& overrides);

/// A setting for each key that the job holds at another value than its default, in the order of
/// its table's rows.
/// @param builtin  The scene whose default job it is, for messages.
[[nodiscard]] Layer layer_from_job(const Job& job, std::string_view builtin);

/// Lays a layer over the settings; a key replaces not only itself but also what it excludes, as
/// light.type = "directional" replaces a cone from below.
void lay_over(Settings& settings, const Layer& layer);

/// What holds after all of them, the weakest first. Where a layer names the method, weaker ones
/// lose what it has no key for: the strongest decides, whatever those between it and them name.
[[nodiscard]] Settings lay_all(std::vector<Layer> layers);

/// Checks settings against each other: keys that exclude or need one another, near and far, …
/// @param source  What to name when a key is missing.
/// @throws InputError  naming the keys and what to do.
void check_settings(const KeyTable& keys, const Settings& settings, const std::string& source);

/// `check_settings`, for the keys that say which scene it is.
void check_scene_choice(const KeyTable& keys, const Settings& settings, const std::string& source);

/// Refuses a setting, naming it.
/// @throws InputError  always: "label: why".
[[noreturn]] void refuse(const Setting& setting, std::string_view why);

/// The setting of that key, or nullptr.
[[nodiscard]] inline const Setting* find_setting(const Settings& settings, std::string_view key)
{
    const auto found = settings.find(key);
    return found == settings.end() ? nullptr : &found->second;
}

} // namespace gnomon::scene
