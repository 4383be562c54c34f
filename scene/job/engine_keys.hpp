#pragma once

#include "scene/job/handed_key.hpp"
#include "scene/job/keys.hpp"

#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Adds the keys that another renderer has of its own, "engine.KEY", to those that are handed to
/// the table of keys: jobs of every method have them. Before a job is read, for rows that were
/// looked at before may lie elsewhere afterwards.
/// @throws std::logic_error  if keys repeat, or are of another table.
void hand_over_engine(std::vector<HandedKey> keys);

/// Adds rows to the end of the table of keys.
void add_key_specs(std::vector<KeySpec> specs);

/// Whether a key, or a table, is of [engine].
[[nodiscard]] bool is_engine_key(std::string_view name);

/// Why keys of [engine] are not known, where no renderer is.
inline constexpr std::string_view engine_place =
    "keys of [engine] are a renderer's own: name it with renderer = \"NAME\" in the job file, "
    "--renderer NAME or --renderer-command";

} // namespace gnomon::scene
