#include "cli/baseline_command.hpp"

#include "cli/exit_codes.hpp"
#include "cli/standard_output.hpp"
#include "reports/gate/baseline_json.hpp"
#include "reports/gate/baseline_read.hpp"
#include "reports/gate/baseline_table.hpp"
#include "reports/gate/gate_run.hpp"
#include "reports/output_file.hpp"
#include "reports/text.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

struct BaselineOptions {
    std::string run;
    std::string file;
};

void save_baseline(const BaselineOptions& options)
{
    const reports::GateRun run = reports::read_gate_run(options.run);
    const std::string folder = scene::one_line(options.run);
    if (!run.status.is_complete()) {
        fmt::print(stderr,
                   "gnomon: {}: {} configurations failed and {} are missing: no baseline is made "
                   "of it; `gnomon status` says how to go on\n",
                   folder, run.status.failed, run.status.missing);
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (run.has_several_environments) {
        throw scene::InputError(fmt::format(
            "{}: its results come from several environments: a baseline is of one", folder));
    }
    const std::string text = reports::baseline_json(run.results);
    if (text.size() > reports::most_baseline_bytes) {
        throw scene::InputError(fmt::format("{}: {} configurations are too many for a baseline of "
                                            "at most {} MiB: sweep fewer",
                                            folder, run.results.entries.size(),
                                            reports::most_baseline_bytes >> 20U));
    }
    reports::write_file(options.file, text);
    print(fmt::format("wrote {}: {}\n", scene::one_line(options.file),
                      reports::counted(run.results.entries.size(), "configuration")));
}

void list_baseline(const BaselineOptions& options)
{
    print(reports::baseline_table(baseline_or_end(options.file)));
}

void compare_with_baseline(const BaselineOptions& options)
{
    const analysis::GateEntries baseline = baseline_or_end(options.file);
    print(reports::baseline_difference(baseline, reports::read_gate_run(options.run).results));
}

} // namespace

analysis::GateEntries baseline_or_end(const std::filesystem::path& file)
{
    try {
        return reports::read_baseline(file);
    } catch (const reports::BaselineMissing& error) {
        fmt::print(stderr, "gnomon: {}\n", error.what());
        throw CLI::RuntimeError{exit_codes::other_environment};
    }
}

void add_baseline_command(CLI::App& program)
{
    auto options = std::make_shared<BaselineOptions>();
    CLI::App* command = program.add_subcommand(
        "baseline", "Save, list or compare the results that a run is held to (`gnomon gate`)");
    command->require_subcommand(1);
    CLI::App* save = command->add_subcommand("save", "Save a run's results as a baseline");
    save->add_option("RUN", options->run, "The folder of `gnomon sweep --out` or `compare --out`")
        ->required();
    save->add_option("--baseline", options->file, "FILE to write; an older one is replaced")
        ->required();
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
    command->footer(
        "Exit status: 0 done; 2 there is no run in RUN, or FILE is no baseline; 3 there "
        "is no baseline; 4 FILE cannot be written; 5 the run is incomplete.\n\n"
        "Examples:\n"
        "  gnomon baseline save run --baseline baseline.json\n"
        "  gnomon baseline diff baseline.json run");
}

} // namespace gnomon::cli
