#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/job/source.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/run_lock.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::cli {

/// The RUN folder of a comparison: a sweep of one configuration, or of one for each light, that
/// keeps its pixels.
class CompareRun {
public:
    /// Takes the folder before the work is done.
    /// @throws scene::InputError, scene::EnvironmentError  as `RunLock` and `RunStore` do.
    /// @param may_replace  a sweep, and results of another scene.
    CompareRun(std::filesystem::path folder, bool may_replace);

    /// Records the comparisons, their layers and the CSV files.
    /// @param source    of the job; its sweep is left aside.
    /// @param lights    the comparison of each of its lights, at least one.
    /// @param defaults  that the job's scene brings along.
    /// @param job_text, command  as in `store::RunDescription`.
    /// @throws scene::InputError        if the folder holds results of another scene that may not
    ///                                  be replaced.
    /// @throws scene::EnvironmentError  if the disk fails.
    void record(scene::JobSource source, std::string_view case_name,
                std::span<const analysis::Comparison> lights, const scene::SceneDefaults& defaults,
                std::string job_text, const std::string& command);

private:
    std::filesystem::path folder_;
    store::OtherScenes other_scenes_;
    store::RunLock lock_;
    store::RunStore store_;
};

} // namespace gnomon::cli
