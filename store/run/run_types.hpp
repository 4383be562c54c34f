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

/// Which part of a divided sweep a run computes; 1 of 1 is all of it.
struct Shard {
    std::uint32_t index = 1; ///< from 1
    std::uint32_t count = 1;

    friend bool operator==(const Shard&, const Shard&) = default;
};

/// A note on a scene of the run.
struct RunNote {
    std::string scene; ///< its name
    scene::SceneNote note;
    std::uint64_t configurations = 0; ///< of the sweep, that it is about

    friend bool operator==(const RunNote&, const RunNote&) = default;
};

/// What a run is: recorded beside its results.
struct RunDescription {
    analysis::Environment environment;
    Shard shard;
    std::uint64_t size = 0; ///< configurations of the sweep, of all its parts
    /// The keys that the sweep varies, and `light` where the job has several: they name a
    /// configuration.
    std::vector<std::string> axes;
    std::string job; ///< the job file's text, or what stands for it
    /// The command that computes it, quoted for a shell, without --out and --shard:
    /// "gnomon sweep job.toml --axis bias.slope=[0,1]".
    std::string command;
    /// The command that computes one configuration, but for its case and its values of the axes:
    /// "gnomon compare job.toml".
    std::string compare_command = {};
    std::vector<RunNote> notes = {};      ///< none in runs of before there were notes
    std::vector<std::string> lights = {}; ///< names; of each every combination of axes is a
                                          ///< configuration; empty: one light
};

/// How a configuration stands.
enum class RunState : std::uint8_t {
    planned = 0, ///< nothing is known of it yet
    done = 1,
    failed = 2,
};

/// A configuration, as far as it takes to tell it from the others.
struct RunRow {
    std::uint64_t ordinal = 0;
    std::string id;
    std::string case_name;                                 ///< empty without cases
    std::string message;                                   ///< why it failed
    std::vector<std::pair<std::string, std::string>> axes; ///< the sweep's keys and their values
};

/// How the configurations of a plan stand.
struct PlanOutcome {
    std::uint64_t done = 0;    ///< of this part's configurations: they are not to be computed again
    std::uint64_t failed = 0;  ///< of this part's
    std::uint64_t planned = 0; ///< of this part's
    std::uint64_t retired = 0; ///< of `plan`: results in the database that it does not ask for
    bool has_equal_ids = false; ///< of `plan`: two ordinals have the same id
};

using VisitConfiguration = std::function<void(const analysis::Configuration&)>;
/// Shows the configurations of a plan one by one: all of them may be too many for the memory.
using ShowConfigurations = std::function<void(const VisitConfiguration& visit)>;

/// How many environments the results of one run may come from.
enum class Environments : std::uint8_t { one, several };

/// Whether a plan may take the place of one that has results of other scenes alone.
enum class OtherScenes : std::uint8_t { refused, replaced };

} // namespace gnomon::store
