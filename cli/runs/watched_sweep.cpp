#include "cli/runs/watched_sweep.hpp"

#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"

#include <memory>

namespace gnomon::cli {

api::SweepOutcome watched_sweep(const scene::SweepSpace& space, const api::SweepRunOptions& options,
                                bool is_quiet)
{
    std::unique_ptr<Progress> progress;
    api::SweepWatcher watcher;
    watcher.begin = [&](std::uint64_t total, std::uint64_t known) {
        progress = std::make_unique<Progress>(total, known, is_quiet);
        stop_on_signals();
    };
    watcher.now = [&](const std::string& configuration) { progress->begin(configuration); };
    watcher.advance = [&](std::uint64_t done, std::uint64_t failed) {
        progress->add(done, failed);
    };
    watcher.end = [&] { progress.reset(); };
    watcher.should_stop = [] { return is_interrupted(); };
    return api::sweep(space, options, watcher);
}

} // namespace gnomon::cli
