#pragma once

#include "api/advice.hpp"
#include "cli/options/job_options.hpp"
#include "scene/job/file.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// --views, --lights, --all-cases.
void add_advice_options(CLI::App& command, api::ViewOptions& options);

/// The views that the options ask for, of each light.
/// @throws scene::InputError  as `api::view_request`, and for --all-cases with --case.
[[nodiscard]] std::vector<analysis::ViewRequest>
view_requests(const api::ViewOptions& options, const JobOptions& job,
              const scene::JobSource& source, std::span<const scene::LightJob> jobs);

/// Says on stderr that a job's cases are left out, where it has some and none is named.
void note_ignored_cases(std::string_view command, const JobOptions& job,
                        const scene::JobSource& source);

} // namespace gnomon::cli
