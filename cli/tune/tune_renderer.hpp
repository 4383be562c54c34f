#pragma once

#include "cli/options/job_options.hpp"
#include "cli/renderer/renderer_options.hpp"

#include <cstddef>
#include <string>

namespace gnomon::cli {

/// The options of `gnomon tune` for another renderer.
struct RendererTuneOptions {
    JobOptions job;
    RendererOptions renderer;
    std::size_t budget = 120; ///< the largest number of settings to draw
    int threads = 0;          ///< of the reference; 0: all cores
    bool json = false;
    bool is_quiet = false;
    bool is_verbose = false;
};

/// Searches the engine's keys that the job leaves open for the smallest mean of the two amount
/// rates. Starts from the job's settings, the engine's defaults and its documentation's values.
/// Ignores settings whose frames show other surfaces. Draws the best setting once more, and prints
/// the result.
/// @throws CLI::RuntimeError        with status 1 if no scored pixel is lit.
/// @throws scene::InputError        as `read_driven_job`, and if there is no key to search.
/// @throws scene::EnvironmentError  if the renderer fails with the job's own settings, cannot be
///                                  started again, or draws the best setting differently again.
void tune_renderer(const RendererTuneOptions& options, RendererCommand command);

} // namespace gnomon::cli
