#pragma once

#include "analysis/advice/judged_views.hpp"
#include "cli/options/job_options.hpp"
#include "scene/job/file.hpp"

#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// From which views advice is made: --views, --lights, --all-cases.
struct AdviceOptions {
    int cameras = 0;
    int lights = 0;
    bool all_cases = false;

    [[nodiscard]] bool any() const { return cameras > 0 || lights > 0 || all_cases; }
};

void add_advice_options(CLI::App& command, AdviceOptions& options);

/// The views that the options ask for.
/// @throws scene::InputError  if --all-cases is given without cases, with --case, or a case changes
///                            more than camera, light and image.
[[nodiscard]] analysis::ViewRequest view_request(const AdviceOptions& options,
                                                 const JobOptions& job);

/// Advice is made of bias curves.
/// @throws scene::InputError  if the method of a light's job has none.
void require_bias_curves(std::string_view command, std::span<const scene::LightJob> jobs);

/// Says on stderr that a job's cases are left out, where it has some and none is named.
void note_ignored_cases(std::string_view command, const JobOptions& job,
                        const scene::JobSource& source);

} // namespace gnomon::cli
