#pragma once

#include "api/scene_session.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/job_options.hpp"
#include "cli/options/methods_option.hpp"
#include "cli/renderer/renderer_options.hpp"

#include <string>
#include <vector>

namespace gnomon::cli {

/// What `gnomon compare` is told.
struct CompareOptions {
    JobOptions job;
    RendererOptions renderer;
    bool json = false;
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

} // namespace gnomon::cli
