#include "cli/options/advice_options.hpp"

#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

constexpr int most_views = 64;

bool is_of_view(const std::string& key)
{
    return key.starts_with("camera.") || key.starts_with("light.") || key.starts_with("image.");
}

/// The keys that must be the same in every view.
std::map<std::string, std::string> shared_keys(const scene::Job& job)
{
    std::map<std::string, std::string> keys;
    for (auto& [key, value] : scene::resolved_keys(job)) {
        if (!is_of_view(key)) {
            keys.emplace(key, value);
        }
    }
    return keys;
}

void require_same_keys(const scene::Job& job, const scene::Job& of_case, const std::string& name)
{
    const auto own = shared_keys(job);
    const auto other = shared_keys(of_case);
    for (const auto* const keys : {&own, &other}) {
        for (const auto& [key, value] : *keys) {
            const auto a = own.find(key);
            const auto b = other.find(key);
            if (a == own.end() || b == other.end() || a->second != b->second) {
                throw scene::InputError(fmt::format(
                    "--all-cases: case {} changes {}: views may differ in camera, light and image "
                    "alone; give that case by itself with --case {}",
                    name, key, name));
            }
        }
    }
}

} // namespace

void add_advice_options(CLI::App& command, AdviceOptions& options)
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

analysis::ViewRequest view_request(const AdviceOptions& options, const JobOptions& job)
{
    analysis::ViewRequest request{options.cameras, options.lights, {}};
    if (!options.all_cases) {
        return request;
    }
    if (!job.case_name.empty()) {
        throw scene::InputError("--case and --all-cases exclude each other: give one of them");
    }
    const scene::JobFile file = read_job(job);
    if (file.cases.empty()) {
        throw scene::InputError("--all-cases: the job has no [[case]]; leave the option out");
    }
    for (const scene::Case& one : file.cases) {
        JobOptions of_case = job;
        of_case.case_name = one.name;
        request.cases.push_back({one.name, read_job(of_case).job});
        require_same_keys(file.job, request.cases.back().job, one.name);
    }
    return request;
}

void require_bias_curves(std::string_view command, std::span<const scene::LightJob> jobs)
{
    for (const scene::LightJob& light : jobs) {
        if (!methods::promises(light.job).has_curve()) {
            throw scene::InputError(fmt::format("{}: method.name = \"{}\" has no bias curve, which "
                                                "advice is made of; `gnomon sweep` "
                                                "tries its keys",
                                                command, light.job.method.name));
        }
    }
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
