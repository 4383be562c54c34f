#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/toml.hpp"
#include "scene/settings/job.hpp"

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::scene {

/// A setting of an engine, and the job's key that it corresponds to:
///
///     engine's value = times · key's value
///
/// A key with words maps to the engine's words.
struct EngineSetting {
    std::string name;  ///< as the engine documents it: "light.shadow.bias"
    std::string line;  ///< what to type, `{}` standing for the value
    std::string about; ///< its unit and sign, in one short phrase
    const Key* key = nullptr;
    const Key* second_key =
        nullptr; ///< a number that the setting gives the same value; may be null
    double times = 1;
    double least = -std::numeric_limits<double>::infinity(); ///< that the engine takes
    double most = std::numeric_limits<double>::infinity();
    std::optional<std::variant<double, std::string>> own_default; ///< the engine's own
    std::map<std::string, std::string, std::less<>> words;        ///< the engine's, by the key's
    /// The setting applies only if each of these keys has one of its words in the job.
    std::map<const Key*, std::vector<std::string>> where;

    [[nodiscard]] bool is_of(const Job& job) const;
};

/// How an engine's users set its shadows: the `[engine]` table of its preset.
struct Engine {
    std::string title;                ///< "three.js"
    std::vector<std::string> aliases; ///< further names, in lower case: "threejs"
    std::string version;              ///< that the description was checked against
    std::string documentation;        ///< where the settings are documented
    std::string comment;              ///< what begins a comment in a line: "//", "#"
    std::vector<EngineSetting> settings;
    std::vector<std::string> also; ///< further lines to type: the engine's defaults add to the bias
};

/// An engine, and its defaults as keys of a job.
struct ReadEngine {
    Engine engine;
    TomlTable job; ///< one key for each setting with a default
};

/// A key's value in a job, default or not.
[[nodiscard]] std::optional<JobValue> engine_key_value(const Key& key, const Job& job);

/// The value as the descriptions write it: a word without quotes, or a number.
[[nodiscard]] std::string engine_word(const JobValue& value);

/// Reads the `[engine]` table of a preset.
/// @param preset  its name, for messages.
/// @throws InputError  if a member is missing or unknown, or a setting's key is not in the table.
[[nodiscard]] ReadEngine read_engine(const KeyTable& keys, std::string_view preset,
                                     const TomlTable& table);

} // namespace gnomon::scene
