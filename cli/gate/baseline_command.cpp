#include "cli/commands.hpp"

#include "analysis/gate/gate_entries.hpp"
#include "cli/exit_codes.hpp"
#include "cli/gate/gate_update.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/gate/baseline_table.hpp"
#include "reports/gate/gate_rule_file.hpp"
#include "reports/text/text.hpp"
#include "scene/one_line.hpp"
#include "store/baseline/baseline_missing.hpp"
#include "store/baseline/baseline_read.hpp"
#include "store/baseline/baseline_write.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/output_name.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

struct BaselineOptions {
    std::string run;
    std::string file;
    std::string rules;
};

void save_baseline(const BaselineOptions& options)
{
    store::require_output_name(options.file, store::OutputKind::baseline);
    const auto points = options.rules.empty()
                            ? std::vector<analysis::CurvePointMetric>{}
                            : store::curve_points_of(reports::read_gate_rules(options.rules));
    const store::GateRun run = store::read_gate_run(options.run, points);
    require_whole_run(run);
    const analysis::GateEntries results = store::write_masks(options.file, run);
    store::write_baseline(options.file, results);
    print(fmt::format("wrote {}: {}, {}\n", scene::one_line(options.file),
                      reports::counted(results.entries.size(), "configuration"),
                      reports::masks_text(results)));
}

/// Reads a baseline; where it is missing, says so and ends the program with exit status 3.
analysis::GateEntries baseline_or_end(const std::filesystem::path& file)
{
    try {
        return store::read_baseline(file);
    } catch (const store::BaselineMissing& error) {
        fmt::print(stderr, "gnomon: {}\n", error.what());
        throw CLI::RuntimeError{exit_codes::other_environment};
    }
}

void list_baseline(const BaselineOptions& options)
{
    print(reports::baseline_table(baseline_or_end(options.file)));
}

void compare_with_baseline(const BaselineOptions& options)
{
    const analysis::GateEntries baseline = baseline_or_end(options.file);
    const store::GateRun run = store::read_gate_run(options.run);
    print(reports::baseline_difference(baseline, store::with_mask_names(run)));
}

} // namespace

void add_baseline_command(CLI::App& program)
{
    auto options = std::make_shared<BaselineOptions>();
    CLI::App* command = program.add_subcommand(
        "baseline", "Save, list or compare the results that a run is held to (`gnomon gate`)");
    command->require_subcommand(1);
    // Before its own commands, which take it over.
    command->footer(
        "Exit status: 0 done; 2 there is no run in RUN, or FILE is no baseline; 3 there "
        "is no baseline; 4 FILE cannot be written; 5 the run is incomplete.\n\n"
        "Examples:\n"
        "  gnomon baseline save run --baseline baseline.json\n"
        "  gnomon baseline diff baseline.json run");
    CLI::App* save = command->add_subcommand("save", "Save a run's results as a baseline");
    save->add_option("RUN", options->run, "The folder of a run, as `gnomon sweep --out` leaves it")
        ->required();
    save->add_option("--baseline", options->file, "FILE to write; an older one is replaced")
        ->required();
    save->add_option("--rules", options->rules,
                     "FILE of rules: keep the points of bias curves that they are about, too");
    save->callback([options] { save_baseline(*options); });
    CLI::App* list = command->add_subcommand("list", "Say what a baseline holds");
    list->add_option("FILE", options->file, "The baseline")->required();
    list->callback([options] { list_baseline(*options); });
    CLI::App* diff =
        command->add_subcommand("diff", "Say what changed, parameter by parameter and metric by "
                                        "metric, without judging it");
    diff->add_option("FILE", options->file, "The baseline")->required();
    diff->add_option("RUN", options->run, "The run to compare with it")->required();
    diff->callback([options] { compare_with_baseline(*options); });
}

} // namespace gnomon::cli
