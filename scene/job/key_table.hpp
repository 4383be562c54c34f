#pragma once

#include "scene/job/handed_key.hpp"
#include "scene/job/job.hpp"
#include "scene/job/job_key.hpp"
#include "scene/job/keys.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The one table of keys.
namespace gnomon::scene {

/// All rows, in the order of a job file; a built-in's parameters follow the other keys of [scene].
[[nodiscard]] const std::vector<KeySpec>& key_specs();

/// The row of that name, or nullptr.
[[nodiscard]] const KeySpec* find_key(std::string_view name);

/// What a job of defaults has the key at, of the same method and layout as the job.
[[nodiscard]] std::optional<JobValue> default_of(const KeySpec& spec, const Job& job);

/// True if a known key is `name` followed by a dot and more.
[[nodiscard]] bool is_key_table(std::string_view name);

/// Every key of the job file but `[sweep]` and `[[case]]`, in the order of docs/job_file.md.
[[nodiscard]] const std::vector<JobKey>& job_keys();

/// The job with every key written out, as (key, TOML value), in the order of `job_keys()`; keys of
/// a camera or light that the job leaves to the scene are absent. The columns of a result table.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job);

/// Says which methods there are, and what keys beside the scene's own: once, and before the table
/// of keys is read. Until then there is one method, "depth", and no such key.
/// @throws std::logic_error  if the table was read already, there is no method, if keys repeat, or
///                           are of another table than `[method]` and `[bias]`.
void hand_over_methods(std::vector<HandedMethod> methods, std::vector<HandedKey> keys);

/// The method of a job that names none: "depth", or without it the first.
[[nodiscard]] const std::string& default_method();

/// The keys that were handed over, in their order.
[[nodiscard]] const std::vector<HandedKey>& handed_keys();

/// Whether jobs of the method of that name have a lookup.filter.
[[nodiscard]] bool has_filters(std::string_view method);

/// Whether jobs of the method of that name have a key: one of the scene's own, which methods share.
[[nodiscard]] bool has_key(std::string_view method, std::string_view key);

/// The same of any key, those that were handed over included.
[[nodiscard]] bool has_any_key(std::string_view method, std::string_view key);

/// The key that was handed over by that name, or nullptr.
[[nodiscard]] const HandedKey* find_handed_key(std::string_view name);

/// Adds the keys that another renderer has of its own, "engine.KEY", to those that are handed to
/// the table of keys: jobs of every method have them. Before a job is read, for rows that were
/// looked at before may lie elsewhere afterwards.
/// @throws std::logic_error  if keys repeat, or are of another table.
void hand_over_engine(std::vector<HandedKey> keys);

/// Whether a key, or a table, is of [engine].
[[nodiscard]] bool is_engine_key(std::string_view name);

/// Why keys of [engine] are not known, where no renderer is.
inline constexpr std::string_view engine_place =
    "keys of [engine] are a renderer's own: name it with renderer = \"NAME\" in the job file, "
    "--renderer NAME or --renderer-command";

} // namespace gnomon::scene
