#include "cli/options/methods_option.hpp"

#include "api/advice.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/tuned_setting.hpp"
#include "scene/counted.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

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
            throw scene::InputError("--max-bytes needs --methods: it bounds the maps of methods "
                                    "that are compared");
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
