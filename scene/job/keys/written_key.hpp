#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// A key as a job spells it: "bias.slope" for all lights, or "lights.sun.bias.slope" for one of
/// several. For one light, keys of [light] have no table: "lights.sun.position".
struct WrittenKey {
    const Key* spec = nullptr;
    std::string light; ///< empty: all lights

    explicit operator bool() const { return spec != nullptr; }
    [[nodiscard]] std::string text() const;
};

/// The key of that name; empty if it is unknown, or cannot be set for a single light.
[[nodiscard]] WrittenKey find_written_key(const KeyTable& keys, std::string_view name);

/// Whether a known key starts with `name` and a dot.
[[nodiscard]] bool is_written_table(const KeyTable& keys, std::string_view name);

/// Whether the key can be set per light: keys of [light], [shadow_map], [lookup], [bias] and
/// [method].
[[nodiscard]] bool is_key_of_light(std::string_view key);

/// The nearest known key, as a job would spell it: the first with the same last part, or else the
/// one with the fewest edits.
/// @param candidates  Other names that are allowed in its place.
[[nodiscard]] std::string nearest_written_key(const KeyTable& keys, std::string_view name,
                                              std::vector<std::string> candidates = {});

/// Whether the name is `preset` or ends with it. This is not a key, but a top-level member of a job
/// file.
[[nodiscard]] bool is_preset_key(std::string_view name);
/// The error text for a preset in another place.
inline constexpr std::string_view preset_place =
    "a job has one preset, for all its lights and cases; write preset = \"NAME\" at the top of "
    "the job file, or give --preset NAME";

/// Names of files and channels begin with a light's name.
inline constexpr std::size_t longest_light_name = 64;

/// Whether the text names a light: up to 64 letters from a to z, digits, _ and -.
[[nodiscard]] bool is_light_name(std::string_view text);

} // namespace gnomon::scene
