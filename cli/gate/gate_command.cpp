#include "cli/commands.hpp"

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "cli/exit_codes.hpp"
#include "cli/gate/baseline_command.hpp"
#include "cli/options/output_files.hpp"
#include "cli/system/process.hpp"
#include "reports/gate/gate_report.hpp"
#include "reports/gate/gate_rule_file.hpp"
#include "reports/gate/gate_text.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/baseline/baseline.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/kept_wrong_pixels.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"
#include "store/sqlite.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace gnomon::cli {
namespace {

/// GitHub drops a step's summary over 1 MiB.
constexpr std::uintmax_t most_summary_bytes = 1'000'000;

void append_summary(const std::filesystem::path& file, const reports::GateReport& report)
{
    std::error_code none;
    const std::uintmax_t known = std::filesystem::file_size(file, none);
    const std::uintmax_t used = none ? 0 : known;
    const std::string text =
        reports::github_summary(report, used < most_summary_bytes ? most_summary_bytes - used : 0);
    errno = 0;
    std::ofstream stream{file, std::ios::binary | std::ios::app};
    stream << text << std::flush;
    if (!stream) {
        throw scene::EnvironmentError(
            fmt::format("{}: cannot be written: {}; check GITHUB_STEP_SUMMARY",
                        scene::one_line(file.string()), std::strerror(errno)));
    }
}

/// Draws the pixels that became wrong and, unless the gate passes, writes a page.
void write_gate_files(reports::GateReport& report, const std::filesystem::path& folder)
{
    reports::write_gate_pictures(report, folder);
    const std::filesystem::path page = folder / "gate.html";
    const bool passes = report.verdict == analysis::GateVerdict::pass;
    if (passes && !std::filesystem::exists(page)) {
        return;
    }
    store::make_folder(folder);
    store::write_file(page, reports::gate_page(report)); // also in place of an earlier failure
    if (!passes) {
        announce_output("gate", page.string());
    }
}

/// Writes pictures and a page into the folder or, if it is empty, into RUN/gate. There a failure
/// only prints a message, because nobody asked for them.
void draw_gate_pictures(reports::GateReport& report, const std::filesystem::path& folder)
{
    if (!folder.empty()) {
        return write_gate_files(report, folder);
    }
    try {
        write_gate_files(report, report.run.folder / "gate");
    } catch (const scene::EnvironmentError& error) {
        fmt::print(stderr, "gnomon: no pictures: {}\n", error.what());
    }
}

/// Prints workflow commands for GitHub Actions, and appends a summary to the file that
/// GITHUB_STEP_SUMMARY names, up to 1 MiB.
/// @throws scene::EnvironmentError  if it cannot be written.
void print_for_github(const reports::GateReport& report)
{
    // Names in the table may look like workflow commands: these are off until a random word.
    std::random_device random;
    const std::string word =
        fmt::format("gnomon-{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
    print(fmt::format("::stop-commands::{}\n{}::{}::\n{}", word,
                      reports::gate_table(report, reports::GateDetail::all), word,
                      reports::github_annotations(report)));
    const char* const file = std::getenv("GITHUB_STEP_SUMMARY");
    if (file != nullptr && *file != '\0') {
        append_summary(file, report);
    }
}

struct GateOptions {
    std::string run;
    std::string baseline;
    std::string rules;
    std::string pictures;
    std::string junit;
    std::string update;
    bool allows_environment = false;
    bool allows_ci_update = false;
    bool json = false;
    bool github = false;
    bool is_verbose = false;
};

/// Prints why the run cannot be compared with the baseline, also as JUnit, and ends the program.
[[noreturn]] void end_without_baseline(const GateOptions& options, const std::string& problem)
{
    fmt::print(stderr, "gnomon: {}\n", problem);
    if (!options.junit.empty()) {
        store::write_file(options.junit, reports::gate_junit_refusal(options.baseline, problem));
    }
    throw CLI::RuntimeError{exit_codes::other_environment};
}

void require_environment(const GateOptions& options, const reports::GateReport& report)
{
    if (options.allows_environment) {
        return;
    }
    std::string problem;
    if (!report.outcome.is_same_renderer) {
        problem = fmt::format("baseline of {}; run of {}",
                              reports::renderer_text(report.baseline.environment),
                              reports::renderer_text(report.run.results.environment));
    } else if (report.run.has_several_environments) {
        problem = "the run's results come from several environments";
    } else {
        return;
    }
    end_without_baseline(
        options,
        fmt::format("{}: {}: save a baseline of this environment, or pass --allow-environment",
                    scene::one_line(options.baseline), problem));
}

/// A rule that matches nothing protects nothing. Missing results may be the reason, though.
void require_matches(const reports::GateReport& report)
{
    if (report.outcome.unmatched_rules.empty() ||
        report.verdict == analysis::GateVerdict::incomplete) {
        return;
    }
    const analysis::GateRule& rule = report.rules[report.outcome.unmatched_rules.front()];
    throw scene::InputError(fmt::format(
        "{}: rule \"{}\" matches nothing: no configuration fits `where` and `job` and has "
        "{}; correct it, or set optional = true",
        rule.place, rule.id, rule.metric));
}

void end_as_verdict(analysis::GateVerdict verdict)
{
    if (verdict != analysis::GateVerdict::pass) {
        throw CLI::RuntimeError{verdict == analysis::GateVerdict::regression
                                    ? exit_codes::negative
                                    : exit_codes::incomplete};
    }
}

/// The file's rules, or the default ones. A file without a rule about scored pixels gets the
/// default one: other rules would pass if nothing were scored.
std::vector<analysis::GateRule> rules_of(const GateOptions& options)
{
    if (options.rules.empty()) {
        return analysis::default_gate_rules();
    }
    std::vector<analysis::GateRule> rules = reports::read_gate_rules(options.rules);
    const bool judges_scored = std::ranges::any_of(rules, [](const analysis::GateRule& rule) {
        return rule.metric == analysis::scored_pixels_metric && rule.where.empty() &&
               rule.job != analysis::JobState::unchanged &&
               rule.severity == analysis::Severity::fail && (rule.min || rule.judges_change());
    });
    if (!judges_scored) {
        std::ranges::move(analysis::tested_rules(), std::back_inserter(rules));
    }
    return rules;
}

/// Reads the run and the baseline; ends the program with exit status 3 if a part of the baseline is
/// missing.
reports::GateReport read_report(const GateOptions& options)
{
    reports::GateReport report;
    report.rules = rules_of(options);
    try {
        report.run = store::read_gate_run(options.run, store::curve_points_of(report.rules));
    } catch (const store::sqlite::DamagedDatabase& error) {
        throw scene::EnvironmentError{error.what()}; // exit status 4, not 2
    }
    report.baseline_file = options.baseline;
    if (options.update.empty()) {
        try {
            report.baseline = store::read_baseline(options.baseline);
            store::require_masks(options.baseline, report.baseline);
        } catch (const store::BaselineMissing& error) {
            end_without_baseline(options, error.what());
        }
    }
    return report;
}

void gate(const GateOptions& options)
{
    require_outputs(std::array{OutputOption{"--junit", options.junit, store::OutputKind::junit}},
                    std::array{InputFile{"the baseline", options.baseline},
                               InputFile{"the rules", options.rules}});
    reports::GateReport report = read_report(options);
    if (!options.update.empty()) {
        return update_baseline({options.baseline, options.update, options.allows_ci_update},
                               report.run);
    }
    report.outcome = analysis::judge_run(report.baseline, report.run.results, report.rules,
                                         store::NewPixelFinder{options.baseline, options.run});
    report.verdict =
        analysis::gate_verdict(report.outcome, report.rules, report.run.status.is_complete());
    require_environment(options, report);
    require_matches(report);
    draw_gate_pictures(report, options.pictures);
    if (!options.junit.empty()) {
        store::write_file(options.junit, reports::gate_junit(report));
    }
    if (options.github) {
        print_for_github(report);
    } else {
        print(options.json
                  ? reports::gate_json(report)
                  : reports::gate_table(report, options.is_verbose ? reports::GateDetail::all
                                                                   : reports::GateDetail::worst));
    }
    end_as_verdict(report.verdict);
}

} // namespace

void add_gate_command(CLI::App& program)
{
    auto options = std::make_shared<GateOptions>();
    CLI::App* command = program.add_subcommand(
        "gate", "Hold a run to a baseline: nothing may be worse than it was");
    command
        ->add_option("RUN", options->run, "The folder of a run, as `gnomon sweep --out` leaves it")
        ->required();
    command
        ->add_option("--baseline", options->baseline, "FILE, as `gnomon baseline save` writes it")
        ->required();
    command->add_option(
        "--rules", options->rules,
        "FILE of rules (docs/gate.md); default: no error may grow, in number or amount");
    command->add_flag("--allow-environment", options->allows_environment,
                      "Compare with a baseline of another renderer, too");
    command->add_option("--pictures", options->pictures,
                        "DIR for pictures of pixels that became wrong; default: RUN/gate");
    CLI::Option* update =
        command
            ->add_option("--update", options->update,
                         "Take the run's results into the baseline instead of judging them: "
                         "configurations that it lacks, those that changed, or all")
            ->check(CLI::IsMember({"missing", "changed", "all"}));
    command->add_flag("--allow-ci-update", options->allows_ci_update,
                      "Let --update write where CI is set");
    CLI::Option* json =
        command->add_flag("--json", options->json, "Print it as JSON (docs/gate.md)")
            ->excludes(update);
    command->add_flag("--verbose", options->is_verbose,
                      "Print every finding, and all that is missing, new or better");
    command->add_option("--junit", options->junit, "Also write it to FILE as JUnit XML")
        ->excludes(update);
    command
        ->add_flag("--github", options->github,
                   "Also annotate a build of GitHub Actions, and write its step summary")
        ->excludes(json)
        ->excludes(update);
    command->footer(
        "Exit status: 0 pass; 1 regression; 2 there is no run in RUN, or a baseline, mask "
        "or rule is bad; 3 there is no baseline, a mask of it is missing, or it is of "
        "another environment; 4 the run cannot be read; 5 results are missing.\n\nExamples:\n"
        "  gnomon gate run --baseline baseline.json\n"
        "  gnomon gate run --baseline baseline.json --verbose\n"
        "  gnomon gate run --baseline baseline.json --rules gate.toml --json\n"
        "  gnomon gate run --baseline baseline.json --github --junit gate.xml\n"
        "  gnomon gate run --baseline baseline.json --update changed");
    command->callback([options] { gate(*options); });
}

} // namespace gnomon::cli
