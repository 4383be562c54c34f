#include "cli/options/advice_options.hpp"

#include "api/advice.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/tune/tuned_setting.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

constexpr int most_views = 64;

std::vector<std::string> split_at_commas(const std::string& text)
{
    std::vector<std::string> words{""};
    for (const char letter : text) {
        if (letter == ',') {
            words.emplace_back();
        } else {
            words.back() += letter;
        }
    }
    return words;
}

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
        throw scene::InputError("--case and --all-cases are mutually exclusive");
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
    fmt::print(
        stderr,
        "gnomon {}: the job's cases ({}) are ignored: choose one with --case, or use all with "
        "--all-cases\n",
        command, fmt::join(names, ", "));
}

void add_methods_option(CLI::App& command, MethodsOption& options)
{
    command.add_option("--methods", options.names,
                       "NAME,… or all: search the settings of these shadow methods, too, with maps "
                       "of at most as many bytes as the job's (docs/tune.md#methods)");
    command
        .add_option("--max-bytes", options.max_bytes,
                    "With --methods: as many bytes in place of the job's")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40U));
}

std::optional<analysis::MethodRequest> method_request(const MethodsOption& options)
{
    if (options.names.empty()) {
        if (options.max_bytes) {
            throw scene::InputError("--max-bytes needs --methods: it limits the maps of the "
                                    "methods compared");
        }
        return std::nullopt;
    }
    return api::method_request(split_at_commas(options.names), options.max_bytes);
}

analysis::MethodProgress method_progress(std::string heading, bool is_verbose)
{
    auto last = std::make_shared<std::string>();
    return {[heading](std::size_t methods, std::size_t settings, std::uint64_t max_bytes) {
                fmt::print(
                    stderr, "{}at most {} of {} are tried, with maps of at most {} bytes ({})\n",
                    heading, scene::counted(settings, "setting"), scene::counted(methods, "method"),
                    max_bytes, reports::mebibytes(max_bytes));
            },
            [heading, last, is_verbose](const analysis::TunedSetting& setting) {
                const bool is_new = setting.method->name != *last;
                *last = setting.method->name;
                if (is_verbose || is_new) {
                    fmt::print(stderr, "{}{}\n", heading, reports::tuned_setting_line(setting));
                }
            }};
}

} // namespace gnomon::cli
