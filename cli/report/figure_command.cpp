#include "cli/commands.hpp"

#include "cli/figures/figures.hpp"
#include "cli/system/process.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

struct FigureOptions {
    std::string name;
    std::vector<std::string> inputs;
    std::string output;
    bool lists = false;
};

std::string figure_table()
{
    std::string text;
    for (const FigureKind& kind : figure_kinds()) {
        text += fmt::format("{:<30}{}  {}\n", kind.name, kind.input, kind.description);
    }
    return text;
}

void check(const FigureOptions& options)
{
    if (options.name.empty()) {
        throw scene::InputError("figure: no name given; `gnomon figure --list` lists them");
    }
    const auto kinds = figure_kinds();
    if (std::none_of(kinds.begin(), kinds.end(),
                     [&](const FigureKind& kind) { return kind.name == options.name; })) {
        throw scene::InputError(fmt::format(
            "figure: unknown figure \"{}\"; `gnomon figure --list` lists them", options.name));
    }
    if (options.inputs.empty()) {
        throw scene::InputError(fmt::format(
            "figure {}: no input given: name a run's folder or CSV files", options.name));
    }
    if (options.output.empty()) {
        throw scene::InputError(fmt::format(
            "figure {}: no output file given: pass -o FILE.pdf, .svg or .png", options.name));
    }
    store::require_output_name(options.output, store::OutputKind::figure);
}

void figure(const FigureOptions& options)
{
    if (options.lists) {
        print(figure_table());
        return;
    }
    check(options);
    draw_figure(options.name, options.inputs, options.output);
}

} // namespace

void add_figure_command(CLI::App& program)
{
    auto options = std::make_shared<FigureOptions>();
    CLI::App* command =
        program.add_subcommand("figure", "Draw a figure from CSV files, for print or the web");
    command->add_option("NAME", options->name, "One that --list names");
    command->add_option(
        "RUN|CSV", options->inputs,
        "A folder of `gnomon sweep` or `compare --out`, CSV files, or for depth-map an "
        "EXR file");
    command->add_option("-o,--output", options->output, "The file: .pdf, .svg or .png");
    command->add_flag("--list", options->lists, "Name the figures");
    command->footer("Needs Debian's python3-matplotlib and python3-pandas; for EXR files also "
                    "python3-openimageio.\n\nExamples:\n"
                    "  gnomon figure bias-curve run -o bias_curve.pdf\n"
                    "  gnomon figure error-vs-z d16.csv d24.csv -o error_vs_z.svg");
    command->callback([options] { figure(*options); });
}

} // namespace gnomon::cli
