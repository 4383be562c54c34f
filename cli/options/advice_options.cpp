#include "cli/options/advice_options.hpp"

#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

constexpr int most_views = 64;

} // namespace

void add_advice_options(CLI::App& command, api::ViewOptions& options)
{
    command
        .add_option("--views", options.cameras,
                    "Make the advice hold for this many cameras around the job's own, too "
                    "(docs/tune.md#views)")
        ->check(CLI::Range(0, most_views));
    command.add_option("--lights", options.lights, "And for this many lights around the job's own")
        ->check(CLI::Range(0, most_views));
    command.add_flag("--all-cases", options.all_cases,
                     "And for the camera, light and image of each [[case]] of the job file");
}

std::vector<analysis::ViewRequest> view_requests(const api::ViewOptions& options,
                                                 const JobOptions& job,
                                                 const scene::JobSource& source,
                                                 std::span<const scene::LightJob> jobs)
{
    if (options.all_cases && !job.case_name.empty()) {
        throw scene::InputError("--case and --all-cases exclude each other: give one of them");
    }
    std::vector<analysis::ViewRequest> requests;
    for (const scene::LightJob& light : jobs) {
        requests.push_back(api::view_request(options, source, light.light));
    }
    return requests;
}

void note_ignored_cases(std::string_view command, const JobOptions& job,
                        const scene::JobSource& source)
{
    if (source.cases.empty() || !job.case_name.empty()) {
        return;
    }
    std::vector<std::string> names;
    for (const scene::CaseLayer& one : source.cases) {
        names.push_back(one.name);
    }
    fmt::print(stderr,
               "gnomon {}: the job's cases ({}) are left out: name one with --case, or make advice "
               "from all with --all-cases\n",
               command, fmt::join(names, ", "));
}

} // namespace gnomon::cli
