#include "cli/tune_command.hpp"

#include "analysis/tune.hpp"
#include "cli/comparison_session.hpp"
#include "cli/exit_codes.hpp"
#include "cli/job_options.hpp"
#include "cli/standard_output.hpp"
#include "reports/text.hpp"
#include "reports/tune_report.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace gnomon::cli {
namespace {

struct TuneOptions {
    JobOptions job;
    SessionOptions session;
    std::string max_false_shadow = "0.1%";
    std::string max_false_lit = "0.5%";
    std::string max_false_shadow_count = "100%";
    std::string max_false_lit_count = "100%";
    int max_resolution = 4096;
    bool json = false;
};

/// "0.1%" or "0.001" as a fraction.
double read_rate(std::string_view option, const std::string& text)
{
    const bool is_percent = text.ends_with('%');
    double value = 0;
    const char* const end = text.data() + text.size() - (is_percent ? 1 : 0);
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const double rate = is_percent ? value / 100 : value;
    if (error != std::errc{} || stop != end || !(rate >= 0 && rate <= 1)) {
        throw scene::InputError(fmt::format(
            "{} {}: must be a share from 0 to 1, or from 0% to 100%, e.g. 0.1%", option, text));
    }
    return rate;
}

void report_progress(const analysis::TunedSetting& setting)
{
    fmt::print(stderr, "gnomon tune: {} {}, slope {:.4g}, offset {:.3g}: {} errors{}\n",
               setting.map.resolution_texels, scene::depth_format_name(setting.map.depth_format),
               setting.slope, setting.normal_texels,
               reports::grouped_amount(setting.error_amount()),
               setting.meets_limits ? ", meets the limits" : "");
}

void tune(const TuneOptions& options)
{
    const analysis::TuneLimits limits{
        read_rate("--max-false-shadow", options.max_false_shadow),
        read_rate("--max-false-lit", options.max_false_lit),
        read_rate("--max-false-shadow-count", options.max_false_shadow_count),
        read_rate("--max-false-lit-count", options.max_false_lit_count), options.max_resolution};
    const scene::Job job = read_job(options.job).job;
    const ComparisonSession session{job, options.session};
    const analysis::TuneResult result =
        analysis::tune(job, session.file(), session.renderers(), limits, report_progress);
    print(options.json ? reports::tune_json(result, limits) : reports::tune_text(result, limits));
    if (!result.meets_limits) {
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

} // namespace

void add_tune_command(CLI::App& program)
{
    auto options = std::make_shared<TuneOptions>();
    CLI::App* command = program.add_subcommand(
        "tune", "Recommend the smallest shadow map whose errors stay below your limits");
    add_job_options(*command, options->job);
    command
        ->add_option("--max-false-shadow", options->max_false_shadow,
                     "Largest amount of shadow on lit pixels, as a share of them, without what a "
                     "filter softens on purpose")
        ->capture_default_str();
    command
        ->add_option("--max-false-lit", options->max_false_lit,
                     "Largest amount of light on blocked pixels, the same")
        ->capture_default_str();
    command
        ->add_option("--max-false-shadow-count", options->max_false_shadow_count,
                     "Largest share of the lit pixels whose verdict may be below one half")
        ->capture_default_str();
    command
        ->add_option("--max-false-lit-count", options->max_false_lit_count,
                     "Largest share of the blocked pixels whose verdict may be one half or more")
        ->capture_default_str();
    command->add_option("--max-resolution", options->max_resolution, "Largest map [texels]")
        ->check(CLI::Range(1, 16384))
        ->capture_default_str();
    command->add_flag("--json", options->json, "Print the result as JSON (docs/tune.md)");
    add_session_options(*command, options->session);
    command->footer("Exit status: 0 a setting meets the limits; 1 none does.\n\nExamples:\n"
                    "  gnomon tune --builtin columns\n"
                    "  gnomon tune job.toml --max-false-shadow 0.05% --max-false-lit 1% "
                    "--max-resolution 2048");
    command->callback([options] { tune(*options); });
}

} // namespace gnomon::cli
