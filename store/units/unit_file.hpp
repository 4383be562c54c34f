#pragma once

#include "store/run/run_checks.hpp"
#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::store {

/// Of which plan a run computes which unit.
struct UnitMark {
    std::string plan; ///< `UnitPlan::id`
    std::string unit; ///< `PlannedUnit::id`

    friend bool operator==(const UnitMark&, const UnitMark&) = default;
};

/// What the name of a unit's file ends in.
inline constexpr const char* unit_extension = ".unit";

/// Where a folder has the results of a unit: FOLDER/ID.unit.
[[nodiscard]] std::filesystem::path unit_path(const std::filesystem::path& folder,
                                              const std::string& unit);

/// The files of units in a folder, by name; none where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> unit_files(const std::filesystem::path& folder);

/// The mark of a unit's database; empty: it is that of a run.
[[nodiscard]] std::optional<UnitMark> read_unit_mark(const sqlite::Database& database);

/// Makes of a run that computed a unit, and that nobody writes, the unit's file: its database with
/// the mark, which appears whole or not at all.
/// @throws scene::EnvironmentError  if it cannot be written.
void publish_unit(const std::filesystem::path& run, const UnitMark& mark,
                  const std::filesystem::path& file);

/// What a unit's file holds.
struct UnitSummary {
    UnitMark mark;
    RunDescription description;      ///< its shard is the unit's number, and how many there are
    std::vector<std::string> scenes; ///< hashes, sorted
    PlanOutcome outcome;
    std::uint64_t retriable = 0; ///< of the failed, those that may pass when tried again
    RunChecks checks;
};

/// @throws sqlite::DamagedDatabase  if the file is not whole.
/// @throws scene::InputError        if it is no unit's, or of another schema.
[[nodiscard]] UnitSummary read_unit_file(const std::filesystem::path& file);

} // namespace gnomon::store
