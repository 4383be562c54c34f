#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// A key as a job writes it: "bias.slope" of all its lights, or "lights.sun.bias.slope" of one of
/// several. Of one light, the keys of [light] stand without their table: "lights.sun.position".
struct WrittenKey {
    const Key* spec = nullptr;
    std::string light; ///< empty: of all lights

    explicit operator bool() const { return spec != nullptr; }
    [[nodiscard]] std::string text() const;
};

/// The key of that name in a table; none if no key has it, or one that a light cannot have for
/// itself.
[[nodiscard]] WrittenKey find_written_key(const KeyTable& keys, std::string_view name);

/// True if a known key may be `name` followed by a dot and more.
[[nodiscard]] bool is_written_table(const KeyTable& keys, std::string_view name);

/// Whether the key may differ from light to light: those of [light], [shadow_map], [lookup], [bias]
/// and [method].
[[nodiscard]] bool is_key_of_light(std::string_view key);

/// The known key nearest to an unknown one, as a job would write it: the first with the same last
/// part, else that of fewest edits.
/// @param candidates  What may also stand where the name was found.
[[nodiscard]] std::string nearest_written_key(const KeyTable& keys, std::string_view name,
                                              std::vector<std::string> candidates = {});

/// Whether the name is `preset`, or ends with it: no key, but a member at a job file's top.
[[nodiscard]] bool is_preset_key(std::string_view name);
/// What to say where it stands elsewhere.
inline constexpr std::string_view preset_place =
    "a job has one preset, for all its lights and cases; write preset = \"NAME\" at the top of "
    "the job file, or give --preset NAME";

/// Names of files and channels begin with it.
inline constexpr std::size_t longest_light_name = 64;

/// Whether the text names a light: up to 64 letters from a to z, digits, _ and -.
[[nodiscard]] bool is_light_name(std::string_view text);

} // namespace gnomon::scene
