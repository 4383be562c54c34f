#include "analysis/lights/light_comparisons.hpp"

#include "analysis/sweep/stage_keys.hpp"
#include "scene/job/file.hpp"

namespace gnomon::analysis {

LightComparisons::LightComparisons(const scene::SceneFile& file, const Renderers& renderers)
    : file_{file},
      renderers_{renderers}
{
}

Comparison LightComparisons::compare(const scene::LightJob& job)
{
    std::string wanted = stage_keys(scene::with_layout(job.job, file_.defaults)).receivers;
    if (kept_ != wanted) {
        receivers_.reset(); // before others take memory
    }
    Comparison comparison = analysis::compare(job.job, file_, renderers_, receivers_);
    kept_ = std::move(wanted);
    comparison.light = job.light;
    return comparison;
}

} // namespace gnomon::analysis
