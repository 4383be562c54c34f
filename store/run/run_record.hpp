#pragma once

#include "analysis/environment.hpp"
#include "store/run/run_types.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The description of a run in its database, its environments and its notes.
/// The environments that the results of a run come from.
namespace gnomon::store {

/// Implements `RunStore::description`; empty before the first plan.
[[nodiscard]] RunDescription read_description(const sqlite::Database& database);

/// The axes of the last plan (`RunDescription::axes`).
[[nodiscard]] std::vector<std::string> read_axes(const sqlite::Database& database);

/// The engine keys in the `light_values` of the last plan's configurations.
[[nodiscard]] std::vector<std::string> read_engine_keys(const sqlite::Database& database);

/// The number of the last plan's environment; 0 without a plan.
[[nodiscard]] std::int64_t environment_number(const sqlite::Database& database);

/// Records the environment, unless it is known; returns its number.
[[nodiscard]] std::int64_t record_environment(const sqlite::Database& database,
                                              const analysis::Environment& environment);

/// "llvmpipe …, GL 4.5 …, Embree 4.0.0, gnomon 1.0".
[[nodiscard]] std::string environment_text(const analysis::Environment& environment);

/// The environment of that number; empty if unknown.
[[nodiscard]] analysis::Environment find_environment(const sqlite::Database& database,
                                                     std::int64_t number);

/// @throws scene::InputError  if a result comes from another environment; it names the difference.
void require_one_environment(const sqlite::Database& database, const analysis::Environment& here);

/// Adds notes on a scene.
/// @param configurations  that the notes concern; added to the number of a note that is known.
void add_notes(std::vector<RunNote>& notes, const std::string& scene,
               std::span<const scene::SceneNote> of_scene, std::uint64_t configurations);

/// Notes as the JSON array that the database holds.
[[nodiscard]] std::string notes_json(std::span<const RunNote> notes);
/// Reads `notes_json`; skips entries that are not notes.
[[nodiscard]] std::vector<RunNote> read_notes(const std::string& json);

/// The notes as sentences. They name the scene if there are several, and the number of
/// configurations if a note does not concern all.
[[nodiscard]] std::vector<std::string> note_sentences(const RunDescription& description);

} // namespace gnomon::store
