#pragma once

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/scene_session.hpp"
#include "api/sweep/sweep_scenes.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// A unit of a planned sweep: what a run computes of it, and no more. Its caller holds the lock of
/// the run's folder.
struct SweepUnit {
    std::vector<std::uint64_t> ordinals; ///< ascending, of whole bias curves
    scene::VertexNormals normals = scene::VertexNormals::dropped; ///< as its plan was made with
    /// Told of each scene that the unit reads, by the job's keys that name it.
    std::function<void(const std::string& keys, const SceneContent& content)> check_scene;
    SceneLoader load_scene; ///< empty: as any sweep does
};

/// How a sweep is run.
struct SweepRunOptions {
    std::filesystem::path folder; ///< RUN
    store::Shard shard;           ///< of a unit its number, and how many there are
    std::optional<SweepUnit> unit;
    bool keeps_pixels = false;
    bool verifies = false; ///< holds every curve to GL's reruns, those done before too
    bool retries_failed = false;
    bool allows_mixed = false; ///< results of several environments in one run
    bool may_replace = false;  ///< results of other scenes
    std::string job_text;
    std::string command;
    std::string compare_command; ///< as in `store::RunDescription`
    SessionOptions session;
};

/// Told how far a sweep is, from any thread but one at a time, and asked whether to go on.
struct SweepWatcher {
    /// Before the first: how many configurations are to be computed, and how many are known.
    std::function<void(std::uint64_t total, std::uint64_t known)> begin = [](std::uint64_t,
                                                                             std::uint64_t) {};
    std::function<void(const std::string& configuration)> now = [](const std::string&) {};
    std::function<void(std::uint64_t done, std::uint64_t failed)> advance = [](std::uint64_t,
                                                                               std::uint64_t) {};
    std::function<void()> end = [] {};
    /// True ends the sweep once what has begun is recorded.
    std::function<bool()> should_stop = [] { return false; };
};

/// How a sweep ended.
struct SweepOutcome {
    std::uint64_t configurations = 0; ///< of this part of the sweep
    std::uint64_t done = 0;           ///< of them, those of earlier runs included
    std::uint64_t failed = 0;
    std::uint64_t retriable = 0; ///< of the failed, those that may pass when tried again
    std::uint64_t repeated = 0;  ///< the same as others, which serve them too
    std::uint64_t retired = 0;   ///< results of an earlier plan that stay in the database
    analysis::PlanCounts counts; ///< the work that was done now
    store::RunChecks checks;     ///< of all that is done
    bool is_interrupted = false;
};

/// Runs what RUN does not hold yet of a sweep, records it there and writes the CSV files, of a unit
/// none.
/// @throws scene::InputError        if another process writes there, or nothing can be computed.
/// @throws scene::EnvironmentError  if GL, Embree or the disk fails; what was recorded stays.
[[nodiscard]] SweepOutcome sweep(const scene::SweepSpace& space, const SweepRunOptions& options,
                                 const SweepWatcher& watcher = {});

} // namespace gnomon::api
