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

/// Records a comparison in a RUN folder, as a sweep of one configuration for each light that keeps
/// its pixels.
class ComparisonRecorder {
public:
    /// Locks the folder, before the comparison begins.
    /// @param may_replace  whether a sweep or results of another scene may be replaced.
    /// @throws scene::InputError, scene::EnvironmentError  as `RunLock` and `RunStore` do.
    ComparisonRecorder(std::filesystem::path folder, bool may_replace);

    /// Records the comparisons, their layers and the CSV files.
    /// @param source    of the job; its sweep is ignored.
    /// @param lights    the comparison of each light; at least one.
    /// @param defaults  of the job's scene.
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
