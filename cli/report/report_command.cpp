#include "cli/commands.hpp"

#include "cli/figures/figures.hpp"
#include "cli/system/process.hpp"
#include "cli/system/progress.hpp"
#include "reports/page/report.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"

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
    bool has_no_figures = false;
};

void make_report_folder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw scene::EnvironmentError(fmt::format("{}: cannot be created: {}; name another folder",
                                                  folder.string(), error.message()));
    }
}

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
    return text + "\n";
}

/// Draws the figures, or notes why there are none.
void add_figures(reports::ReportOptions& report, const CommandOptions& options)
{
    if (options.has_no_figures) {
        report.no_figures = "they were not asked for (--no-figures).";
        return;
    }
    try {
        for (const FigureFile& figure : draw_run_figures(report.out, report.out / "figures")) {
            report.figures.push_back(
                {figure.name, figure.title, figure.caption, figure.alt, figure.svg, figure.png});
        }
    } catch (const PythonMissing& error) {
        report.no_figures = error.what();
        fmt::print(stderr, "gnomon: no figures: {}\n", error.what());
    }
}

void report(const CommandOptions& options)
{
    reports::ReportOptions report;
    report.folder = options.run;
    report.out = options.out.empty() ? options.run : options.out;
    report.only = options.only;
    make_report_folder(report.out);
    std::optional<SlowWork> work{std::in_place, "writing the CSV files"};
    reports::write_report_csv(report.folder, report.out);
    work->now("drawing the figures");
    add_figures(report, options);
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
        "report", "Write a page to read and explore a run, a summary, CSV files and figures");
    command
        ->add_option("RUN", options->run, "The folder of `gnomon sweep --out` or `compare --out`")
        ->required();
    command->add_option("--out", options->out, "DIR, where the report goes; default: RUN");
    command->add_option("--configuration", options->only,
                        "ID of a configuration whose pixels the page is to hold; default: as many "
                        "as fit, the best first");
    command->add_flag("--no-figures", options->has_no_figures, "Draw no figures");
    command->footer("Exit status: 0 written; 2 there is no run in RUN; 4 a file cannot be "
                    "written.\n\nExamples:\n"
                    "  gnomon compare --builtin columns --out run && gnomon report run\n"
                    "  gnomon report run --out public");
    command->callback([options] { report(*options); });
}

} // namespace gnomon::cli
