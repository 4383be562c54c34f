#pragma once

#include "analysis/sweep/units.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// The job of a plan, as the command line named it, and the text of its file: a plan is computed
/// where that file is not.
struct PlannedJob {
    std::string path; ///< empty: none was given
    std::string text; ///< of a job file; empty of a scene file
    std::string builtin;
    std::string preset;
    std::string case_name;
    std::optional<std::string> light;
    std::vector<std::string> settings; ///< KEY=VALUE
    std::vector<std::string> axes;     ///< KEY=VALUES
};

/// A scene that units read, by its content.
struct PlannedScene {
    std::string name; ///< for messages
    std::string keys; ///< the job's keys that name it: `analysis::StageKeys::scene`
    std::string hash; ///< `scene::content_hash`; empty: it could not be read
    /// A hash of the camera, the light and the normals that it brings along.
    std::string brought;

    friend bool operator==(const PlannedScene&, const PlannedScene&) = default;
};

/// A unit of work: configurations that one process computes.
struct PlannedUnit {
    std::string id;           ///< 16 hexadecimal digits: a hash of what it is to compute
    std::uint32_t number = 0; ///< from 1, in the order of the plan
    double seconds = 0;       ///< estimated
    std::uint64_t configurations = 0;
    std::vector<std::string> scenes; ///< hashes of those that it reads
    std::vector<analysis::OrdinalRun> ordinals;
};

/// A sweep in units (docs/scaling.md#plan).
struct UnitPlan {
    std::string id;     ///< 16 hexadecimal digits: a hash of all the rest but `directory`
    std::string gnomon; ///< version of the program that made it
    std::filesystem::path directory; ///< where it was made: relative paths begin there
    PlannedJob job;
    std::string command;         ///< as in `RunDescription`
    std::string compare_command; ///< likewise
    std::uint64_t size = 0;      ///< configurations of the sweep
    bool keeps_normals = false;  ///< scenes are read with the normals of their vertices
    std::vector<PlannedScene> scenes;
    std::vector<PlannedUnit> units;
};

/// Gives the units their numbers and ids, and the plan its own.
void complete_plan(UnitPlan& plan);

/// The plan as JSON lines: first what holds for all units, then a unit a line.
[[nodiscard]] std::string plan_text(const UnitPlan& plan);

/// @throws scene::InputError  if it cannot be read, is no plan, is not whole or was changed: its id
///                            is no longer that of its text.
[[nodiscard]] UnitPlan read_unit_plan(const std::filesystem::path& path);

/// The unit that is named by its id or by its number.
/// @param path  of the plan, for messages.
/// @throws scene::InputError  if there is none.
[[nodiscard]] const PlannedUnit& find_unit(const UnitPlan& plan, std::string_view name,
                                           const std::filesystem::path& path);

} // namespace gnomon::store
