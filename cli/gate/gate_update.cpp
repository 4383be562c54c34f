#include "cli/gate/gate_update.hpp"

#include "analysis/gate/baseline_update.hpp"
#include "cli/exit_codes.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/gate/baseline_table.hpp"
#include "reports/gate/gate_names.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/baseline/baseline_missing.hpp"
#include "store/baseline/baseline_read.hpp"
#include "store/baseline/baseline_write.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

namespace gnomon::cli {

namespace {

using analysis::BaselineUpdate;

BaselineUpdate update_of(const std::string& name)
{
    return name == "missing"   ? BaselineUpdate::missing
           : name == "changed" ? BaselineUpdate::changed
                               : BaselineUpdate::all;
}

/// A build that changes what it is held to would always pass.
void require_no_ci(const UpdateOptions& options)
{
    const char* const ci = std::getenv("CI");
    if (ci != nullptr && *ci != '\0' && !options.allows_ci) {
        throw scene::InputError("--update: CI is set, and a build must not change what it is held "
                                "to: update where you commit, or pass --allow-ci-update");
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

void require_unitable(const UpdateOptions& options, const analysis::GateEntries& baseline,
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

} // namespace

void require_whole_run(const store::GateRun& run)
{
    const std::string folder = scene::one_line(run.folder.string());
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
}

void update_baseline(const UpdateOptions& options, const store::GateRun& run)
{
    require_no_ci(options);
    require_whole_run(run);
    const BaselineUpdate update = update_of(options.update);
    const auto known = known_baseline(options.baseline);
    if (known && update != BaselineUpdate::all) {
        require_unitable(options, *known, run.results);
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

} // namespace gnomon::cli
