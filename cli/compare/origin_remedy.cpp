#include "cli/compare/origin_remedy.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/comparison/lookup_cost.hpp"
#include "analysis/sweep/compare.hpp"
#include "scene/view/moved_scene.hpp"

#include <fmt/format.h>

namespace gnomon::cli {

void advise_origin(analysis::Comparison& comparison, const api::ComparisonSession& session,
                   const api::SessionOptions& options)
{
    const auto& kinds = comparison.precision_kinds;
    if (!kinds || kinds->transform <= kinds->format) {
        return;
    }
    const auto moved = scene::move_origin_near(comparison.job, session.file());
    if (!moved) {
        return;
    }
    const api::SceneSession scene_session{session.context(), moved->file.scene, options};
    const analysis::Comparison there =
        analysis::compare(moved->job, moved->file, scene_session.renderers());
    const scene::Vec3f origin{moved->origin}; // which float32 holds, with fewer digits to read
    comparison.advice.push_back(
        {{fmt::format("{}the scene's origin to [{}, {}, {}]", analysis::origin_comment, origin.x,
                      origin.y, origin.z)},
         {{there.metrics.false_shadow, there.metrics.false_lit},
          there.metrics.amounts,
          there.diagnosis ? there.diagnosis->causes.amounts.softening() : 0,
          there.diagnosis ? there.diagnosis->left_out().total() : 0},
         there.metrics.error_rate,
         analysis::lookup_cost(comparison.job),
         analysis::MeasuredBy::rerun});
    if (there.diagnosis) {
        comparison.advice.back().left = analysis::named_errors(there);
    }
}

} // namespace gnomon::cli
