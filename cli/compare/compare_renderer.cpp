#include "cli/compare/compare_renderer.hpp"

#include "cli/compare/compare_outputs.hpp"
#include "cli/options/advice_options.hpp"
#include "cli/options/command_text.hpp"
#include "cli/renderer/driven_job.hpp"
#include "cli/runs/renderer_run.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// Options that ask something of GL.
void refuse_options_of_gl(const CompareOptions& options)
{
    refuse_for_renderer({{"--depth-map", !options.depth_map_path.empty()},
                         {"--heat-map", !options.heat_maps.empty()},
                         {"--view-depths", !options.view_depths_path.empty()},
                         {"--export-case", !options.case_folder.empty()},
                         {"--truth float", options.truth != "exact"},
                         {"--audit", options.audit},
                         {"--advise", options.advise},
                         {"--verify", options.verify},
                         {"--device", options.session.device.has_value()}});
}

} // namespace

void compare_renderer(const CompareOptions& options, RendererCommand command)
{
    refuse_options_of_gl(options);
    RendererSession session{
        renderer_settings(std::move(command), options.renderer, options.session.threads)};
    const scene::JobSource source = read_driven_job(session, options.job);
    require_new_outputs(options, scene::light_jobs(source, options.job.case_name));
    note_ignored_cases("compare", options.job, source);
    const scene::SweepSpace space = space_of_one(source, options.job.case_name);
    api::SweepRunOptions settings;
    settings.folder = options.folder;
    settings.keeps_pixels = true;
    settings.allows_mixed = true;
    settings.may_replace = options.force;
    settings.job_text = job_text(options.job);
    settings.command = command_text("compare", options.job) + renderer_text(options.renderer);
    settings.compare_command = settings.command;
    std::optional<RendererRun> run;
    if (!options.folder.empty()) {
        run.emplace(space, settings);
        run->plan(session);
    }
    const scene::SweepPoint point = space.at(0);
    const analysis::Comparison comparison =
        session.compare(space.job(point), key_names(space.given_keys(point)));
    if (run) {
        run->record(0, comparison);
        (void)run->finish();
    }
    session.close();
    write_outputs(options, {&comparison, 1});
}

} // namespace gnomon::cli
