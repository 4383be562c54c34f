#include "cli/sweep/extreme_pixels.hpp"

#include "analysis/sweep/compare.hpp"
#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/compare.hpp"
#include "cli/system/process.hpp"
#include "methods/job_method.hpp"
#include "reports/page/run_overview.hpp"
#include "scene/error.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace gnomon::cli {
namespace {

/// A configuration to keep the layers of.
struct Extreme {
    std::string name;
    std::uint64_t ordinal = 0;
    std::string id;
};

Extreme extreme(std::string name, const store::ResultRow& row)
{
    return {std::move(name), row.count("ordinal"), row.text("id")};
}

/// The id of the job without axes; with several lights, of the first one.
/// @return  Empty if the sweep has only the cases, or the job's keys conflict.
/// @throws scene::InputError  if the job's scene cannot be read.
std::string id_without_axes(scene::JobSource source, std::string_view case_name)
{
    if (case_name.empty() && !source.cases.empty()) {
        return {};
    }
    source.sweep = {};
    const scene::SweepSpace space{std::move(source), {}, case_name};
    const analysis::SweepCurves sweep_curves{space, true, GNOMON_VERSION};
    if (sweep_curves.requests().empty()) {
        return {};
    }
    const scene::Job job = sweep_curves.job(0);
    const scene::SceneFile file = scene::load_scene(job.scene, methods::vertex_normals(job));
    std::string id;
    sweep_curves.describe(0,
                          analysis::identify_scene(job, scene::content_hash(file.scene),
                                                   file.defaults, scene::normals_hash(file.scene)),
                          [&](const analysis::Configuration& own) { id = own.id; });
    return id;
}

/// `id_without_axes`; also empty if the job's own scene cannot be read, as axes may set others.
std::string own_id(scene::JobSource source, std::string_view case_name)
{
    try {
        return id_without_axes(std::move(source), case_name);
    } catch (const scene::InputError&) {
        return {};
    }
}

/// The best, the worst and the job's own configuration of one case, or of a job without cases.
void add_extremes(std::vector<Extreme>& found, const store::RunReader& run,
                  const store::ResultRow& best, const store::ResultRow& worst,
                  const std::string& own, std::string_view of)
{
    found.push_back(extreme(fmt::format("the best{}", of), best));
    found.push_back(extreme(fmt::format("the worst{}", of), worst));
    const auto rows = run.rows(fmt::format("WHERE status = 'done' AND id = '{}' LIMIT 1", own));
    if (!rows.empty()) {
        found.push_back(extreme(fmt::format("the job's own{}", of), rows.front()));
    }
}

std::vector<Extreme> find_extremes(const std::filesystem::path& folder,
                                   const scene::JobSource& source, std::string_view case_name)
{
    const store::RunReader run{folder};
    const reports::RunOverview overview = reports::read_overview(run);
    std::vector<Extreme> found;
    if (!overview.has_cases && !overview.rows.empty()) {
        add_extremes(found, run, overview.rows.front().result, overview.rows.back().result,
                     own_id(source, case_name), "");
    }
    for (std::size_t i = 0; i < overview.worst.size(); ++i) {
        const store::ResultRow& best = overview.rows[i].result;
        add_extremes(found, run, best, overview.worst[i].result, own_id(source, best.text("case")),
                     " of each case");
    }
    return found;
}

} // namespace

std::vector<std::string> keep_extreme_pixels(const std::filesystem::path& folder,
                                             const scene::SweepSpace& space,
                                             const scene::JobSource& source,
                                             std::string_view case_name,
                                             const api::SessionOptions& options)
{
    std::vector<std::string> names;
    for (const Extreme& kept : find_extremes(folder, source, case_name)) {
        if (is_interrupted()) {
            break;
        }
        if (!std::filesystem::exists(store::pixels_path(folder, kept.id))) {
            const scene::Job job = space.job(space.at(kept.ordinal));
            const api::ComparisonSession session{job, options};
            api::keep_pixels(folder, kept.id,
                             analysis::compare(job, session.file(), session.renderers()));
        }
        if (std::ranges::find(names, kept.name) == names.end()) {
            names.push_back(kept.name);
        }
    }
    return names;
}

} // namespace gnomon::cli
