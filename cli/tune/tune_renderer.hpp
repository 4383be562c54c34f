#pragma once

#include "cli/options/job_options.hpp"
#include "cli/renderer/renderer_options.hpp"

#include <cstddef>
#include <string>

namespace gnomon::cli {

/// What `gnomon tune` of another renderer is told.
struct RendererTuneOptions {
    JobOptions job;
    RendererOptions renderer;
    std::size_t budget = 120; ///< settings that are drawn at most
    int threads = 0;          ///< of the reference; 0: all cores
    bool json = false;
    bool is_quiet = false;
    bool is_verbose = false;
};

/// Searches the engine's keys that the job does not set itself for the smallest mean of the two
/// amount rates, from the job's settings, the engine's defaults and what its documentation
/// recommends on. Settings whose frames show other surfaces do not count. Draws what it found once
/// more, and prints both.
/// @throws CLI::RuntimeError        with status 1 where no scored pixel is lit.
/// @throws scene::InputError        as `read_driven_job`, and if the renderer has nothing to
/// search.
/// @throws scene::EnvironmentError  if the renderer fails over the job's own settings, cannot be
///                                  started again, or draws what was found otherwise than before.
void tune_renderer(const RendererTuneOptions& options, RendererCommand command);

} // namespace gnomon::cli
