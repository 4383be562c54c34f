#pragma once

#include "store/run/run_checks.hpp"
#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::store {

/// The unit, and its plan, that a run computes.
struct UnitMark {
    std::string plan; ///< `UnitPlan::id`
    std::string unit; ///< `PlannedUnit::id`

    friend bool operator==(const UnitMark&, const UnitMark&) = default;
};

/// The extension of unit files.
inline constexpr const char* unit_extension = ".unit";

/// The unit file in a folder: FOLDER/ID.unit.
[[nodiscard]] std::filesystem::path unit_path(const std::filesystem::path& folder,
                                              const std::string& unit);

/// The unit files in a folder, by name; none if the folder does not exist.
[[nodiscard]] std::vector<std::filesystem::path> unit_files(const std::filesystem::path& folder);

/// The mark in a unit's database; empty for a run's database.
[[nodiscard]] std::optional<UnitMark> read_unit_mark(const sqlite::Database& database);

/// Writes the unit file of a run, atomically: the run's database with the mark.
/// @param run  that computed the unit; nobody else writes it.
/// @throws scene::EnvironmentError  if the file cannot be written.
void publish_unit(const std::filesystem::path& run, const UnitMark& mark,
                  const std::filesystem::path& file);

/// The content of a unit file.
struct UnitSummary {
    UnitMark mark;
    RunDescription description;      ///< its shard is the unit's number and the number of units
    std::vector<std::string> scenes; ///< hashes, sorted
    PlanOutcome outcome;
    std::uint64_t retriable = 0; ///< failed ones that may pass when tried again
    RunChecks checks;
};

/// @throws sqlite::DamagedDatabase  if the file is incomplete.
/// @throws scene::InputError        if the file is not a unit file, or has another schema.
[[nodiscard]] UnitSummary read_unit_file(const std::filesystem::path& file);

} // namespace gnomon::store
