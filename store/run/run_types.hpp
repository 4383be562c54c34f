#pragma once

#include "analysis/environment.hpp"
#include "analysis/results/results.hpp"
#include "scene/load/scene_notes.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// The version of the database's tables and of the CSV files' columns.
inline constexpr int run_schema = 2;

/// The part of a divided sweep that a run computes; 1 of 1 is the whole sweep.
struct Shard {
    std::uint32_t index = 1; ///< from 1
    std::uint32_t count = 1;

    friend bool operator==(const Shard&, const Shard&) = default;
};

/// A note on one of the run's scenes.
struct RunNote {
    std::string scene; ///< its name
    scene::SceneNote note;
    std::uint64_t configurations = 0; ///< that the note concerns

    friend bool operator==(const RunNote&, const RunNote&) = default;
};

/// The description of a run, recorded with its results.
struct RunDescription {
    analysis::Environment environment;
    Shard shard;
    std::uint64_t size = 0; ///< configurations in all parts of the sweep
    /// The keys that the sweep varies, and `light` if the job has several lights.
    std::vector<std::string> axes;
    std::string job; ///< text of the job file, or an equivalent
    /// The command that computes the run, quoted for a shell, without --out and --shard:
    /// "gnomon sweep job.toml --axis bias.slope=[0,1]".
    std::string command;
    /// The command that computes one configuration, without its case and its values of the axes:
    /// "gnomon compare job.toml".
    std::string compare_command = {};
    std::vector<RunNote> notes = {};
    std::vector<std::string> lights = {}; ///< names, if there are several lights
};

/// The state of a configuration.
enum class RunState : std::uint8_t {
    planned = 0, ///< not computed yet
    done = 1,
    failed = 2,
};

/// What identifies a configuration, and why it failed.
struct RunRow {
    std::uint64_t ordinal = 0;
    std::string id;
    std::string case_name;                                 ///< empty without cases
    std::string message;                                   ///< why it failed
    std::vector<std::pair<std::string, std::string>> axes; ///< the sweep's keys and their values
};

/// The configurations of this part of a plan, by state.
struct PlanOutcome {
    std::uint64_t done = 0;
    std::uint64_t failed = 0;
    std::uint64_t planned = 0;
    std::uint64_t retired = 0;  ///< results that the new plan does not need; only set by `plan`
    bool has_equal_ids = false; ///< two ordinals have the same id; only set by `plan`
};

using VisitConfiguration = std::function<void(const analysis::Configuration&)>;
/// Visits the configurations of a plan one by one, because all may not fit into memory.
using ShowConfigurations = std::function<void(const VisitConfiguration& visit)>;

/// Whether the results of one run may come from several environments.
enum class Environments : std::uint8_t { one, several };

/// Whether a plan may replace one whose results all belong to other scenes.
enum class OtherScenes : std::uint8_t { refused, replaced };

} // namespace gnomon::store
