#include "cli/gate/baseline_command.hpp"

#include "analysis/gate/gate_entries.hpp"
#include "cli/commands.hpp"
#include "cli/exit_codes.hpp"
#include "cli/system/process.hpp"
#include "reports/gate/baseline_table.hpp"
#include "reports/gate/gate_rule_file.hpp"
#include "reports/gate/gate_text.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/baseline/baseline.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

using analysis::BaselineUpdate;

BaselineUpdate update_of(const std::string& name)
{
    return name == "missing"   ? BaselineUpdate::missing
           : name == "changed" ? BaselineUpdate::changed
                               : BaselineUpdate::all;
}

/// A CI build that updates its own baseline would always pass.
void require_no_ci(const UpdateOptions& options)
{
    const char* const ci = std::getenv("CI");
    if (ci != nullptr && *ci != '\0' && !options.allows_ci) {
        throw scene::InputError(
            "--update: CI is set, and a build must not change its own baseline: "
            "update where you commit, or pass --allow-ci-update");
    }
}

std::optional<analysis::GateEntries> known_baseline(const std::filesystem::path& file)
{
    try {
        return store::read_baseline(file);
    } catch (const store::BaselineMissing&) {
        return std::nullopt;
    }
}

void require_mergeable(const UpdateOptions& options, const analysis::GateEntries& baseline,
                       const analysis::GateEntries& run)
{
    const std::string file = scene::one_line(options.baseline.string());
    if (!analysis::is_same_renderer(baseline.environment, run.environment)) {
        fmt::print(stderr, "gnomon: {}: baseline of {}; run of {}: replace it with --update all\n",
                   file, reports::renderer_text(baseline.environment),
                   reports::renderer_text(run.environment));
        throw CLI::RuntimeError{exit_codes::other_environment};
    }
    if (!analysis::can_be_merged(baseline, run)) {
        throw scene::InputError(
            fmt::format("{}: the run sweeps other axes: replace it with --update all", file));
    }
}

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

/// Reads a baseline. If it is missing, prints that and ends the program with exit status 3.
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

void require_whole_run(const store::GateRun& run)
{
    const std::string folder = scene::one_line(run.folder.string());
    if (!run.status.is_complete()) {
        fmt::print(stderr,
                   "gnomon: {}: {} configurations failed and {} are missing: a baseline needs a "
                   "complete run; `gnomon status` says how to go on\n",
                   folder, run.status.failed, run.status.missing);
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (run.has_several_environments) {
        throw scene::InputError(fmt::format(
            "{}: its results come from several environments, but a baseline needs one", folder));
    }
}

void update_baseline(const UpdateOptions& options, const store::GateRun& run)
{
    require_no_ci(options);
    require_whole_run(run);
    const BaselineUpdate update = update_of(options.update);
    const auto known = known_baseline(options.baseline);
    if (known && update != BaselineUpdate::all) {
        require_mergeable(options, *known, run.results);
    }
    const analysis::GateEntries results = store::write_masks(options.baseline, run);
    const analysis::GateEntries updated =
        known ? analysis::updated_baseline(*known, results, update) : results;
    store::write_baseline(options.baseline, updated);
    const std::string changes =
        known ? reports::baseline_difference(*known, updated) : std::string{};
    print(fmt::format("{}wrote {}: {}, {}\n", changes, scene::one_line(options.baseline.string()),
                      reports::counted(updated.entries.size(), "configuration"),
                      reports::masks_text(updated)));
}

void add_baseline_command(CLI::App& program)
{
    auto options = std::make_shared<BaselineOptions>();
    CLI::App* command = program.add_subcommand(
        "baseline", "Save, list or compare the results that a run is held to (`gnomon gate`)");
    command->require_subcommand(1);
    // Set before its commands are added: they inherit it.
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
