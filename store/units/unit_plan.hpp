#pragma once

#include "analysis/sweep/units.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// The job of a plan, as given on the command line, with the text of its file, because workers may
/// lack the file.
struct PlannedJob {
    std::string path; ///< empty: not given
    std::string text; ///< of a job file; empty for a scene file
    std::string builtin;
    std::string preset;
    std::string case_name;
    std::optional<std::string> light;
    std::vector<std::string> settings; ///< KEY=VALUE
    std::vector<std::string> axes;     ///< KEY=VALUES
};

/// A scene that units read.
struct PlannedScene {
    std::string name; ///< for messages
    std::string keys; ///< job keys that name the scene: `analysis::StageKeys::scene`
    std::string hash; ///< `scene::content_hash`; empty: could not be read
    /// A hash of the scene file's camera, light and normals.
    std::string brought;

    friend bool operator==(const PlannedScene&, const PlannedScene&) = default;
};

/// Configurations that one process computes.
struct PlannedUnit {
    std::string id;           ///< 16 hexadecimal digits: a hash of its work
    std::uint32_t number = 0; ///< from 1, in the order of the plan
    double seconds = 0;       ///< estimated
    std::uint64_t configurations = 0;
    std::vector<std::string> scenes; ///< hashes of the scenes that it reads
    std::vector<analysis::OrdinalRun> ordinals;
};

/// A sweep divided into units (docs/scaling.md#plan).
struct UnitPlan {
    std::string id;     ///< 16 hexadecimal digits: a hash of all members except `directory`
    std::string gnomon; ///< version of the program that made the plan
    std::filesystem::path directory; ///< where the plan was made; relative paths start here
    PlannedJob job;
    std::string command;         ///< as in `RunDescription`
    std::string compare_command; ///< as in `RunDescription`
    std::uint64_t size = 0;      ///< configurations of the sweep
    bool keeps_normals = false;  ///< scenes are read with vertex normals
    std::vector<PlannedScene> scenes;
    std::vector<PlannedUnit> units;
};

/// Sets the numbers and ids of the units, and the id of the plan.
void complete_plan(UnitPlan& plan);

/// The plan as JSON lines: one for the whole plan, then one for each unit.
[[nodiscard]] std::string plan_text(const UnitPlan& plan);

/// @throws scene::InputError  if the file cannot be read, is not a plan, is incomplete, or was
///                            edited, so that its id does not match.
[[nodiscard]] UnitPlan read_unit_plan(const std::filesystem::path& path);

/// Finds a unit by its id or its number.
/// @param path  of the plan, for messages.
/// @throws scene::InputError  if there is no such unit.
[[nodiscard]] const PlannedUnit& find_unit(const UnitPlan& plan, std::string_view name,
                                           const std::filesystem::path& path);

} // namespace gnomon::store
