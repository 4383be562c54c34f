#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/loaded_scene.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/job_options.hpp"
#include "cli/renderer/renderer_options.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/file.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The options of `gnomon compare`.
struct CompareOptions {
    JobOptions job;
    RendererOptions renderer;
    bool json = false;
    bool verbose = false;
    std::string engine; ///< empty: not given
    std::string aov_path;
    std::string picture_path;
    std::string depth_map_path;
    std::vector<std::string> heat_maps; ///< NAME=FILE
    std::string view_depths_path;
    int view_depth_bands = 16;
    std::string folder;      ///< RUN
    std::string case_folder; ///< of --export-case
    bool force = false;
    std::string truth = "exact";
    bool audit = false;
    bool advise = false;
    api::ViewOptions advice;
    MethodsOption methods;
    bool verify = false;
    api::SessionOptions session;
};

/// Checks before the work that the outputs can be written.
/// @param jobs  the job of each light. With several, only --aov is a single file.
/// @throws scene::InputError, scene::EnvironmentError  as `require_outputs` and `require_absent`.
void require_new_outputs(const CompareOptions& options, std::span<const scene::LightJob> jobs);

/// Writes the outputs that GL draws anew: the depth map, and a case for `gnomon evaluate`.
/// @param renderers  of the comparison.
/// @throws scene::EnvironmentError  if it cannot be written.
void write_from_gl(const CompareOptions& options, const analysis::Comparison& comparison,
                   const scene::SceneDefaults& defaults, const analysis::Renderers& renderers);

/// Writes the other output files, and prints the result.
/// @param lights  the comparison of each light, at least one.
/// @throws scene::EnvironmentError  if a file cannot be written.
void write_outputs(const CompareOptions& options, std::span<const analysis::Comparison> lights);

} // namespace gnomon::cli
