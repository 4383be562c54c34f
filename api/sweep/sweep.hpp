#pragma once

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/loaded_scene.hpp"
#include "api/sweep/sweep_scenes.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_store.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// A unit of a planned sweep: the part that a run computes. The caller holds the lock of the run's
/// folder.
struct SweepUnit {
    std::vector<std::uint64_t> ordinals; ///< ascending; covers whole bias curves
    scene::VertexNormals normals = scene::VertexNormals::dropped; ///< as for the plan
    /// Called with each scene that the unit reads, and the job's keys that name it.
    std::function<void(const std::string& keys, const SceneContent& content)> check_scene;
    SceneLoader load_scene; ///< empty for the default loader
};

struct SweepRunOptions {
    std::filesystem::path folder; ///< RUN
    store::Shard shard;           ///< for a unit its number and the number of units
    std::optional<SweepUnit> unit;
    bool keeps_pixels = false;
    bool verifies = false; ///< checks every curve against GL reruns, also those computed before
    bool retries_failed = false;
    bool allows_mixed = false; ///< allows results of several environments in one run
    bool may_replace = false;  ///< allows replacing results of other scenes
    std::string job_text;
    std::string command;
    std::string compare_command; ///< as in `store::RunDescription`
    SessionOptions session;
};

/// Callbacks for progress and cancellation. Called from any thread, one at a time.
struct SweepWatcher {
    /// Called once at the start, with the number of configurations to compute and of known ones.
    std::function<void(std::uint64_t total, std::uint64_t known)> begin = [](std::uint64_t,
                                                                             std::uint64_t) {};
    std::function<void(const std::string& configuration)> now = [](const std::string&) {};
    std::function<void(std::uint64_t done, std::uint64_t failed)> advance = [](std::uint64_t,
                                                                               std::uint64_t) {};
    std::function<void()> end = [] {};
    /// Returns true to end the sweep after recording work in progress.
    std::function<bool()> should_stop = [] { return false; };
};

/// How a sweep ended.
struct SweepOutcome {
    std::uint64_t configurations = 0; ///< in this part of the sweep
    std::uint64_t done = 0;           ///< of these, including earlier runs
    std::uint64_t failed = 0;
    std::uint64_t retriable = 0; ///< failed configurations that may succeed when retried
    std::uint64_t repeated = 0;  ///< duplicates, which share the other's results
    std::uint64_t retired = 0;   ///< results of an earlier plan that stay in the database
    analysis::PlanCounts counts; ///< work done in this run
    store::RunChecks checks;     ///< of all results
    bool is_interrupted = false;
};

/// Computes the configurations that RUN still lacks, records them there and writes the CSV files
/// (not for a unit).
/// @throws scene::InputError        if another process writes to RUN, or no configuration can be
///                                  computed.
/// @throws scene::EnvironmentError  if GL, Embree or the disk fails; recorded results stay.
[[nodiscard]] SweepOutcome sweep(const scene::SweepSpace& space, const SweepRunOptions& options,
                                 const SweepWatcher& watcher = {});

/// The difference of two ascending lists.
[[nodiscard]] inline std::vector<std::uint64_t> without(const std::vector<std::uint64_t>& all,
                                                        const std::vector<std::uint64_t>& others)
{
    std::vector<std::uint64_t> rest;
    std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                        std::back_inserter(rest));
    return rest;
}

/// The intersection of two ascending lists.
[[nodiscard]] inline std::vector<std::uint64_t> common(const std::vector<std::uint64_t>& some,
                                                       const std::vector<std::uint64_t>& others)
{
    std::vector<std::uint64_t> both;
    std::set_intersection(some.begin(), some.end(), others.begin(), others.end(),
                          std::back_inserter(both));
    return both;
}

} // namespace gnomon::api
