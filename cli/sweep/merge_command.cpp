#include "cli/commands.hpp"

#include "cli/exit_codes.hpp"
#include "cli/system/process.hpp"
#include "reports/tables/run_status_text.hpp"
#include "reports/text/text.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_status.hpp"
#include "store/run_folder/pixels.hpp"
#include "store/run_folder/run_lock.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// Ends the program with the exit status that a run's status calls for, as `gnomon sweep` does: 5
/// if it is incomplete, 4 if a check of its results failed; returns otherwise.
void end_as(const store::RunStatus& status)
{
    if (!status.is_complete()) {
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (!status.checks.are_passed()) {
        throw CLI::RuntimeError{exit_codes::environment_failed};
    }
}

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

struct MergeOptions {
    std::string out;
    std::vector<std::string> runs;
    bool allow_mixed = false;
};

/// Removes the folder at the end if it did not exist before and is empty.
class NewFolder {
public:
    explicit NewFolder(std::filesystem::path path)
        : path_{std::move(path)},
          is_new_{!std::filesystem::exists(path_, none_)}
    {
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder()
    {
        if (is_new_) {
            std::filesystem::remove(path_, none_); // refuses a folder with entries
        }
    }

private:
    std::error_code none_;
    std::filesystem::path path_;
    bool is_new_;
};

/// "3, 7-9 and 12": ascending numbers.
std::string ranges_text(const std::vector<std::uint32_t>& numbers)
{
    std::vector<std::string> ranges;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t end = i + 1;
        while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) {
            ++end;
        }
        ranges.push_back(end - i == 1 ? fmt::format("{}", numbers[i])
                                      : fmt::format("{}-{}", numbers[i], numbers[end - 1]));
        i = end;
    }
    return fmt::format("{}", fmt::join(ranges, ", "));
}

/// Prints on stderr which units' files are damaged, repeated or missing.
void report_units(const store::MergeOutcome& merged)
{
    for (const std::string& damaged : merged.damaged) {
        fmt::print(stderr, "gnomon: ignored: {}\n", damaged);
    }
    if (merged.repeated > 0) {
        fmt::print(stderr, "gnomon: {} of a unit that another file holds: counted once\n",
                   merged.repeated == 1
                       ? std::string{"1 file is"}
                       : fmt::format("{} files are each", reports::grouped(merged.repeated)));
    }
    if (!merged.missing_units.empty()) {
        fmt::print(stderr,
                   "gnomon: {} of {} missing: {}; compute with `gnomon run-unit PLAN "
                   "NUMBER --out DIR`, and merge again\n",
                   reports::grouped(merged.missing_units.size()),
                   reports::counted(merged.unit_count, "unit"), ranges_text(merged.missing_units));
    }
}

void merge(const MergeOptions& options)
{
    constexpr std::uint64_t most_rows = 20;
    const NewFolder folder{options.out};
    const store::RunLock lock{options.out};
    const std::vector<std::filesystem::path> runs(options.runs.begin(), options.runs.end());
    const store::MergeOutcome merged = store::merge_runs(
        options.out, runs,
        options.allow_mixed ? store::Environments::several : store::Environments::one);
    for (const std::filesystem::path& run : runs) {
        store::take_pixels(options.out, run);
    }
    report_units(merged);
    const store::RunStatus status = store::read_run_status(options.out, most_rows);
    print(reports::run_status_text(status));
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

void add_merge_command(CLI::App& program)
{
    auto options = std::make_shared<MergeOptions>();
    CLI::App* command =
        program.add_subcommand("merge", "Unite the shards or the units of a sweep, or overlapping "
                                        "runs of it");
    command->add_option("OUT", options->out, "The folder of the united run: a new one")->required();
    command
        ->add_option("RUN", options->runs,
                     "Folders that `gnomon sweep --out` wrote; files that `gnomon run-unit` wrote, "
                     "or folders of them")
        ->required();
    command->add_flag("--allow-mixed", options->allow_mixed,
                      "Unite results of different drivers or versions too");
    command->footer(
        "Exit status: 0 complete; 2 the runs do not fit together, or OUT holds one; 4 as "
        "of `gnomon status`; 5 united, but configurations failed or are missing.\n\nExamples:\n"
        "  gnomon merge all part1 part2 part3\n"
        "  gnomon merge all units\n"
        "  gnomon status all");
    command->callback([options] { merge(*options); });
}

} // namespace gnomon::cli
