#include "analysis/lights/light_comparisons.hpp"

#include "analysis/sweep/stage_keys.hpp"
#include "scene/job/file.hpp"

namespace gnomon::analysis {

LightComparisons::LightComparisons(const scene::SceneFile& file, const Renderers& renderers)
    : file_{file},
      renderers_{renderers}
{
    renderers_.draw_receivers = [this, draw = renderers.draw_receivers](const scene::View& view) {
        if (kept_ != wanted_) {
            receivers_ = draw(view);
            kept_ = wanted_;
        }
        return receivers_;
    };
}

Comparison LightComparisons::compare(const scene::LightJob& job)
{
    wanted_ = stage_keys(scene::with_layout(job.job, file_.defaults)).receivers;
    Comparison comparison = analysis::compare(job.job, file_, renderers_);
    comparison.light = job.light;
    return comparison;
}

} // namespace gnomon::analysis
