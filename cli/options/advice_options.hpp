#pragma once

#include "analysis/tune/method_tune.hpp"
#include "api/advice.hpp"
#include "cli/options/job_options.hpp"
#include "scene/job/file.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Adds --views, --lights and --all-cases.
void add_advice_options(CLI::App& command, api::ViewOptions& options);

/// The views that the options ask for, for each light.
/// @throws scene::InputError  as `api::view_request`, and for --all-cases with --case.
[[nodiscard]] std::vector<analysis::ViewRequest>
view_requests(const api::ViewOptions& options, const JobOptions& job,
              const scene::JobSource& source, std::span<const scene::LightJob> jobs);

/// Warns on stderr if the job has cases and no --case chooses one.
void note_ignored_cases(std::string_view command, const JobOptions& job,
                        const scene::JobSource& source);

/// The methods to search: --methods, --max-bytes.
struct MethodsOption {
    std::string names; ///< "NAME,NAME" or "all"; empty: only the job's own
    std::optional<std::uint64_t> max_bytes;
};

void add_methods_option(CLI::App& command, MethodsOption& options);

/// The methods to search; empty without --methods.
/// @throws scene::InputError  for an unknown name, and for --max-bytes without --methods.
[[nodiscard]] std::optional<analysis::MethodRequest> method_request(const MethodsOption& options);

/// Prints on stderr how large the search is, then each method as it begins or, if verbose, every
/// setting.
/// @param heading  Begins each line: "gnomon tune: ".
[[nodiscard]] analysis::MethodProgress method_progress(std::string heading, bool is_verbose);

} // namespace gnomon::cli
