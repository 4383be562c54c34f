#include "cli/commands.hpp"

#include "cli/system/process.hpp"
#include "cli/units/planned_sweep.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

struct PlanOptions {
    JobOptions job;
    std::vector<std::string> axes;
    std::size_t units = 0;
    std::string out;
    std::string scenes;
};

void plan(const PlanOptions& options)
{
    const std::string text =
        store::plan_text(plan_sweep(options.job, options.axes, options.units, options.scenes));
    if (options.out.empty()) {
        print(text);
    } else {
        store::write_file(options.out, text);
    }
}

} // namespace

void add_plan_command(CLI::App& program)
{
    auto options = std::make_shared<PlanOptions>();
    CLI::App* command = program.add_subcommand(
        "plan", "Divide a sweep into units of work, for many machines (docs/scaling.md)");
    add_job_options(*command, options->job);
    command
        ->add_option("--axis", options->axes,
                     "KEY=VALUES adds an axis or replaces the job's, as of `gnomon sweep`")
        ->allow_extra_args(false);
    command
        ->add_option("--units", options->units,
                     "At most so many units; without it each takes about a minute")
        ->check(CLI::Range(std::size_t{1}, most_units));
    command->add_option("--out", options->out,
                        "The file for the plan; without it goes to standard output");
    command->add_option("--scenes", options->scenes,
                        "A folder for the scenes that are files, packed, by their content: for "
                        "machines where the files are not");
    command->footer("Exit status: 0 done; 2 the job or every scene of it is at fault.\n\n"
                    "Examples:\n"
                    "  gnomon plan job.toml --units 200 --out plan.jsonl\n"
                    "  gnomon run-unit plan.jsonl 1 --out units\n"
                    "  gnomon merge run units");
    command->callback([options] { plan(*options); });
}

} // namespace gnomon::cli
