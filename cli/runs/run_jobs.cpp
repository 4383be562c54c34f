#include "cli/runs/run_jobs.hpp"

#include "methods/key_table.hpp"
#include "reports/page/run_overview.hpp"
#include "scene/error.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/text.hpp"
#include "store/run/run_commands.hpp"
#include "store/run/run_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnomon::cli {
namespace {

using reports::OverviewRow;

void require_run_of_gl(const store::RunReader& run, const std::string& folder)
{
    const analysis::Environment& environment = run.description().environment;
    if (run.description().command.starts_with("gnomon evaluate ") || !environment.is_of_gl()) {
        throw scene::InputError(fmt::format(
            "{}: {} drew these shadows, so Gnomon has no job to compare", folder,
            environment.gl_renderer.empty() ? "another renderer" : environment.gl_renderer));
    }
}

std::vector<OverviewRow> best_rows(const store::RunReader& run)
{
    std::vector<OverviewRow> rows;
    for (const std::string& condition : reports::comparable_groups(run)) {
        auto ends = reports::best_and_worst(run, condition);
        if (!ends.empty()) {
            rows.push_back(std::move(ends.front()));
        }
    }
    return rows;
}

/// The rows of one configuration: one for each light.
std::vector<OverviewRow> chosen_rows(const store::RunReader& run, const std::string& id)
{
    std::vector<OverviewRow> rows;
    if (id.find_first_not_of("0123456789abcdef") != std::string::npos) {
        return rows; // no ID, and not to be written into SQL
    }
    for (store::ResultRow& row :
         run.rows(fmt::format("WHERE status = 'done' AND id = '{}' ORDER BY ordinal", id))) {
        rows.push_back(reports::named_row(run, std::move(row)));
    }
    return rows;
}

RunJob job_of_row(const OverviewRow& row)
{
    std::vector<scene::Override> keys;
    for (auto& [key, value] : store::job_settings(row.result)) {
        keys.push_back({std::move(key), std::move(value)});
    }
    const scene::JobSource source =
        scene::job_source_of_text("job.toml", "", keys, {}, methods::key_table());
    return {row.result.text("id"),
            row.result.text("case"),
            row.settings,
            {row.result.text(scene::light_distinction), scene::make_job(source)}};
}

} // namespace

std::vector<RunJob> jobs_of_run(const std::filesystem::path& folder,
                                const std::string& configuration)
{
    const std::string name = scene::one_line(folder.string());
    const store::RunReader run{folder};
    require_run_of_gl(run, name);
    const std::vector<OverviewRow> rows =
        configuration.empty() ? best_rows(run) : chosen_rows(run, configuration);
    if (rows.empty()) {
        throw scene::InputError(
            configuration.empty()
                ? fmt::format("{}: no configuration was measured", name)
                : fmt::format("{}: it has no measured configuration {}; the IDs are in its "
                              "results.csv",
                              name, scene::one_line(configuration)));
    }
    std::vector<RunJob> jobs;
    std::ranges::transform(rows, std::back_inserter(jobs), job_of_row);
    return jobs;
}

} // namespace gnomon::cli
