#include "cli/commands.hpp"

#include "cli/runs/run_ending.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/tables/run_status_text.hpp"
#include "store/run/run_status.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

struct StatusOptions {
    std::string run;
    bool json = false;
    bool all = false;
};

void show_status(const StatusOptions& options)
{
    constexpr std::uint64_t some_rows = 20;
    const store::RunStatus status = store::read_run_status(
        options.run, options.all ? std::numeric_limits<std::uint64_t>::max() : some_rows);
    print(options.json ? reports::run_status_json(status) : reports::run_status_text(status));
    end_as(status);
}

} // namespace

void add_status_command(CLI::App& program)
{
    auto options = std::make_shared<StatusOptions>();
    CLI::App* command =
        program.add_subcommand("status", "Say how far a sweep is, what failed and what is missing");
    command->add_option("RUN", options->run, "The folder of `gnomon sweep --out`")->required();
    command->add_flag("--json", options->json, "Print it as JSON (docs/runs.md)");
    command->add_flag("--all", options->all,
                      "List every failed and missing configuration, not the first 20 of each");
    command->footer(
        "Exit status: 0 complete; 2 there is no run in RUN; 4 complete, but GL and the "
        "truth, or the bias curve, disagree where they must not; 5 configurations failed "
        "or are missing.\n\nExample:\n"
        "  gnomon status run");
    command->callback([options] { show_status(*options); });
}

} // namespace gnomon::cli
