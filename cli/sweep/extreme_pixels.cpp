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

std::vector<Extreme> find_extremes(const std::filesystem::path& folder, scene::JobSource source,
                                   std::string_view case_name)
{
    const store::RunReader run{folder};
    const reports::RunOverview overview = reports::read_overview(run);
    std::vector<Extreme> found;
    if (overview.rows.empty()) {
        return found;
    }
    found.push_back(extreme("the best", overview.rows.front().result));
    found.push_back(extreme("the worst", overview.rows.back().result));
    const auto own = run.rows(fmt::format("WHERE status = 'done' AND id = '{}' LIMIT 1",
                                          own_id(std::move(source), case_name)));
    if (!own.empty()) {
        found.push_back(extreme("the job's own", own.front()));
    }
    return found;
}

} // namespace

std::vector<std::string> keep_extreme_pixels(const std::filesystem::path& folder,
                                             const scene::SweepSpace& space,
                                             scene::JobSource source, std::string_view case_name,
                                             const api::SessionOptions& options)
{
    std::vector<std::string> names;
    for (const Extreme& kept : find_extremes(folder, std::move(source), case_name)) {
        if (is_interrupted()) {
            break;
        }
        if (!std::filesystem::exists(store::pixels_path(folder, kept.id))) {
            const scene::Job job = space.job(space.at(kept.ordinal));
            const api::ComparisonSession session{job, options};
            api::keep_pixels(folder, kept.id,
                             analysis::compare(job, session.file(), session.renderers()));
        }
        names.push_back(kept.name);
    }
    return names;
}

} // namespace gnomon::cli
