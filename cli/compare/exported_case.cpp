#include "cli/compare/exported_case.hpp"

#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "api/compare.hpp"
#include "methods/job_method.hpp"
#include "scene/view/view.hpp"
#include "store/case/case_write.hpp"

namespace gnomon::cli {

void export_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                 const scene::SceneDefaults& defaults, const analysis::Renderers& renderers)
{
    const scene::Job& job = comparison.job;
    store::CaseExtras extras{api::points_of(comparison),
                             scene::resolve_camera(job, *comparison.triangles, defaults),
                             scene::resolve_light(job, defaults),
                             {},
                             {}};
    renderers::Rasterizer& rasterizer = renderers.rasterizer;
    const renderers::Drawn drawn{rasterizer.draw_receivers(comparison.view),
                                 renderers::draw_filtered_map(rasterizer, job, comparison.view)};
    if (!methods::traits(job).has_one_tap()) {
        extras.map_depths = drawn.map->map().depths();
    }
    if (!analysis::can_derive_unbiased(job, comparison.view)) {
        scene::View unbiased = comparison.view;
        unbiased.bias = {};
        extras.unmoved = rasterizer.look_up({drawn, job, unbiased});
    }
    store::write_case(folder, comparison, extras);
}

} // namespace gnomon::cli
