#include "cli/runs/comparison_recorder.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/compare.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/text.hpp"
#include "store/run/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {

namespace {

/// Removes keys that another renderer's case does not set: their defaults are Gnomon's, not its
/// own.
void keep_given(std::vector<std::pair<std::string, std::string>>& parameters,
                const std::vector<std::string>& given)
{
    std::erase_if(parameters, [&](const auto& parameter) {
        return std::ranges::find(given, parameter.first) == given.end();
    });
}

} // namespace

ComparisonRecorder::ComparisonRecorder(std::filesystem::path folder, bool may_replace)
    : folder_{std::move(folder)},
      other_scenes_{may_replace ? store::OtherScenes::replaced : store::OtherScenes::refused},
      lock_{folder_},
      store_{folder_, store::RunStore::Access::write}
{
    const store::RunDescription earlier = store_.description();
    if (!may_replace && earlier.size > std::max<std::size_t>(1, earlier.lights.size())) {
        throw scene::InputError(fmt::format(
            "--out {}: holds a sweep, which this would replace: name another folder, or pass "
            "--force",
            scene::one_line(folder_.string())));
    }
}

void ComparisonRecorder::record(scene::JobSource source, std::string_view case_name,
                                std::span<const analysis::Comparison> lights,
                                const scene::SceneDefaults& defaults, std::string job_text,
                                const std::string& command)
{
    source.sweep = {};
    if (case_name.empty()) {
        source.cases.clear();
    }
    const scene::SweepSpace space{std::move(source), {}, case_name};
    const analysis::SweepCurves sweep_curves{space, true, GNOMON_VERSION};
    // Results of another driver in the folder are replaced.
    store::RunDescription description{lights.front().environment, {},      lights.size(), {},
                                      std::move(job_text),        command, command};
    description.axes = space.distinctions();
    description.lights = space.lights();
    std::vector<analysis::Configuration> configurations;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const analysis::Comparison& comparison = lights[i];
        sweep_curves.describe(
            i,
            analysis::identify_scene(comparison.job, comparison.scene.hash, defaults,
                                     scene::normals_hash(*comparison.triangles)),
            [&](const analysis::Configuration& own) { configurations.push_back(own); });
        if (comparison.evaluation) {
            keep_given(configurations.back().parameters, comparison.evaluation->given_keys);
        }
        store::add_notes(description.notes, comparison.scene.name, comparison.scene.notes, 1);
    }
    store_.plan(description, configurations, store::Environments::several, other_scenes_);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        api::keep_pixels(folder_, configurations[i].id, lights[i]);
        store_.record(analysis::finish_compared(lights[i], configurations[i].curve, i));
    }
    store_.write_csv();
}

} // namespace gnomon::cli
