#include "cli/sweep/merge_command.hpp"

#include "cli/sweep/run_ending.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/tables/run_status_text.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_status.hpp"
#include "store/run_folder/pixels.hpp"
#include "store/run_folder/run_lock.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

struct MergeOptions {
    std::string out;
    std::vector<std::string> runs;
    bool allow_mixed = false;
};

/// A folder that goes again if it was made meanwhile and nothing was put in it.
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

void merge(const MergeOptions& options)
{
    constexpr std::uint64_t most_rows = 20;
    const NewFolder folder{options.out};
    const store::RunLock lock{options.out};
    const std::vector<std::filesystem::path> runs(options.runs.begin(), options.runs.end());
    store::merge_runs(options.out, runs,
                      options.allow_mixed ? store::Environments::several
                                          : store::Environments::one);
    for (const std::filesystem::path& run : runs) {
        store::take_pixels(options.out, run);
    }
    const store::RunStatus status = store::read_run_status(options.out, most_rows);
    print(reports::run_status_text(status));
    end_as(status);
}

} // namespace

void add_merge_command(CLI::App& program)
{
    auto options = std::make_shared<MergeOptions>();
    CLI::App* command =
        program.add_subcommand("merge", "Unite the shards of a sweep, or overlapping runs of it");
    command->add_option("OUT", options->out, "The folder of the united run: a new one")->required();
    command->add_option("RUN", options->runs, "Folders that `gnomon sweep --out` wrote")
        ->required();
    command->add_flag("--allow-mixed", options->allow_mixed,
                      "Unite results of different drivers or versions too");
    command->footer(
        "Exit status: 0 complete; 2 the runs do not fit together, or OUT holds one; 4 as "
        "of `gnomon status`; 5 united, but configurations failed or are missing.\n\nExamples:\n"
        "  gnomon merge all part1 part2 part3\n"
        "  gnomon status all");
    command->callback([options] { merge(*options); });
}

} // namespace gnomon::cli
