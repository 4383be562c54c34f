#include "cli/commands.hpp"

#include "api/comparison_session.hpp"
#include "cli/exit_codes.hpp"
#include "cli/options/session_options.hpp"
#include "cli/system/standard_output.hpp"
#include "cli/units/run_unit.hpp"
#include "reports/text/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

struct RunUnitOptions {
    UnitRunOptions unit;
    std::string retry;
};

void run_unit_command(const RunUnitOptions& options)
{
    UnitRunOptions run = options.unit;
    run.retries_failed = !options.retry.empty();
    const UnitOutcome outcome = run_unit(std::move(run));
    const api::SweepOutcome& sweep = outcome.sweep;
    if (sweep.is_interrupted) {
        fmt::print(stderr, "gnomon: interrupted; the same command goes on where this stopped\n");
        throw CLI::RuntimeError{exit_codes::interrupted};
    }
    print(fmt::format("unit {} of {}, {} of {} done{}: {}\n", outcome.number, outcome.count,
                      reports::grouped(sweep.done),
                      reports::counted(sweep.configurations, "configuration"),
                      outcome.was_known ? " before" : "", outcome.file.string()));
    if (sweep.failed > 0) {
        fmt::print(stderr, "gnomon: {} failed{}\n", reports::counted(sweep.failed, "configuration"),
                   sweep.retriable > 0 ? "; --retry failed tries again" : "");
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (!sweep.checks.are_passed()) {
        fmt::print(stderr, "gnomon: {}\n", store::failed_checks_text(sweep.checks));
        throw CLI::RuntimeError{exit_codes::environment_failed};
    }
}

} // namespace

void add_run_unit_command(CLI::App& program)
{
    auto options = std::make_shared<RunUnitOptions>();
    CLI::App* command = program.add_subcommand(
        "run-unit", "Compute one unit of a planned sweep; resumes where it was stopped");
    command->add_option("PLAN", options->unit.plan, "The file that `gnomon plan` wrote")
        ->required();
    command->add_option("UNIT", options->unit.unit, "Its id, or its number from 1 on")->required();
    command
        ->add_option("--out", options->unit.folder,
                     "The folder for the file of its results, ID.unit")
        ->required();
    command->add_option("--scenes", options->unit.scenes,
                        "A folder of scenes that `gnomon plan --scenes` packed; what it lacks is "
                        "read where the job says");
    command->add_option("--retry", options->retry, "failed: compute failed configurations again")
        ->check(CLI::IsMember({"failed"}));
    command->add_flag("--quiet", options->unit.is_quiet, "No progress on stderr");
    add_session_options(*command, options->unit.session);
    command->footer(
        "Exit status: 0 the file is there and all are done; 2 there is no such unit, or the plan "
        "is of other scenes or another version; 4 GL, Embree or the disk failed, or GL and the "
        "truth disagree where they must not; 5 the file is there, but some failed; 130 "
        "interrupted.\n\nExamples:\n"
        "  gnomon run-unit plan.jsonl 7 --out units\n"
        "  parallel gnomon run-unit plan.jsonl {} --out units ::: $(seq 200)");
    command->callback([options] { run_unit_command(*options); });
}

} // namespace gnomon::cli
