#include "cli/commands.hpp"

#include "api/compare.hpp"
#include "cli/figures/figures.hpp"
#include "cli/runs/run_jobs.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "reports/page/report.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"
#include "store/run/run_reader.hpp"
#include "store/run_folder/pixels.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

struct CommandOptions {
    std::string run;
    std::string out;
    std::vector<std::string> only;
    std::string against;
    bool has_figures = false;
    bool has_no_figures = false;
};

std::string outcome_text(const fs::path& out, const reports::ReportOutcome& outcome)
{
    std::string text = fmt::format("{}\n  pixels of {}", (out / "report.html").string(),
                                   reports::counted(outcome.images, "configuration"));
    if (outcome.images_left_out > 0) {
        text += fmt::format(" ({} more were kept, but would make the page too large: choose with "
                            "--configuration ID)",
                            reports::grouped(outcome.images_left_out));
    }
    if (!outcome.schema.empty()) {
        text += fmt::format("\n  {}", outcome.schema);
    }
    return text + "\n  beside it: summary.md, the CSV files and the pictures\n";
}

/// Draws the figures, or notes why they are missing.
void add_figures(reports::ReportOptions& report)
{
    try {
        for (const FigureFile& figure : draw_run_figures(report.out, report.out / "figures")) {
            report.figures.push_back(
                {figure.name, figure.title, figure.caption, figure.alt, figure.svg, figure.png});
        }
    } catch (const PythonMissing& error) {
        report.no_figures = fmt::format("The figures are missing: {}", error.what());
        fmt::print(stderr, "gnomon: no figures: {}\n", error.what());
    }
}

/// Computes and keeps the pixels of the chosen configurations that the run did not keep.
/// @throws scene::InputError  if the run has no such configuration, or this machine draws with
///                            another renderer.
void keep_chosen_pixels(const CommandOptions& options)
{
    for (const std::string& id : options.only) {
        if (store::has_image(options.run, id)) {
            continue;
        }
        const std::vector<scene::LightJob> job{jobs_of_run(options.run, id).front().job};
        const api::ComparisonSession session{job, {}};
        const analysis::Comparison comparison = api::compare(session, job).front();
        const store::RunReader run{options.run, store::RunStore::Access::read_older};
        const std::string& renderer = run.description().environment.gl_renderer;
        if (renderer != comparison.environment.gl_renderer) {
            throw scene::InputError(fmt::format(
                "--configuration {}: the run was drawn by {}, this machine draws with {}", id,
                renderer, comparison.environment.gl_renderer));
        }
        api::keep_pixels(options.run, id, comparison);
    }
}

void report(const CommandOptions& options)
{
    reports::ReportOptions report;
    report.folder = options.run;
    report.out = options.out.empty() ? options.run : options.out;
    report.only = options.only;
    report.against = options.against;
    store::make_folder(report.out);
    std::optional<SlowWork> work{std::in_place, "writing the CSV files"};
    reports::write_report_csv(report.folder, report.out);
    if (!options.only.empty()) {
        work->now("computing the chosen pixels");
        keep_chosen_pixels(options);
    }
    if (options.has_figures) {
        work->now("drawing the figures");
        add_figures(report);
    }
    work->now("writing the page");
    const reports::ReportOutcome outcome = reports::write_report(report);
    work.reset();
    for (const std::string& problem : outcome.problems) {
        fmt::print(stderr, "gnomon: pixels left out: {}\n", problem);
    }
    print(outcome_text(report.out, outcome));
}

} // namespace

void add_report_command(CLI::App& program)
{
    auto options = std::make_shared<CommandOptions>();
    CLI::App* command = program.add_subcommand(
        "report", "Write a page to read and explore a run, a summary and CSV files");
    command
        ->add_option("RUN", options->run, "The folder of `gnomon sweep --out` or `compare --out`")
        ->required();
    command->add_option("--out", options->out, "DIR, where the report goes; default: RUN");
    command->add_option(
        "--configuration", options->only,
        "ID of a configuration whose pixels the page holds, computed if the run did "
        "not keep them; default: as many as fit, the best first");
    command->add_option("--against", options->against,
                        "RUN of before: show what changed in settings, results and pixels");
    auto* figures = command->add_flag("--figures", options->has_figures,
                                      "Also draw figures for papers with matplotlib (PNG, SVG)");
    command
        ->add_flag("--no-figures", options->has_no_figures,
                   "Draw no figures: the default, kept for older scripts")
        ->excludes(figures);
    command->footer("Exit status: 0 written; 2 there is no run in RUN; 4 a file cannot be "
                    "written.\n\nExamples:\n"
                    "  gnomon compare --builtin columns --out run && gnomon report run\n"
                    "  gnomon report run --against run-of-last-week\n"
                    "  gnomon report run --out public --figures");
    command->callback([options] { report(*options); });
}

} // namespace gnomon::cli
