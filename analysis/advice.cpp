#include "analysis/advice.hpp"

#include "analysis/metrics.hpp"
#include "analysis/tune_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::analysis {

using scene::Job;

namespace {

constexpr int largest_resolution_texels = 16384;

/// A job with some keys changed, and the keys.
struct Variant {
    Job job;
    std::vector<std::string> keys;
};

/// Whether pixels are wrong or partial by it.
bool has(const CauseLayers& causes, Cause cause)
{
    return causes.counts.of(cause) > 0 || causes.amounts.of(cause) > 0;
}

/// Whether texels are too large for what they are asked.
bool has_coarse_texels(const CauseLayers& causes)
{
    return has(causes, Cause::resolution) || has(causes, Cause::filter);
}

/// Maps that miss less.
void add_wider_maps(const Job& job, std::vector<Variant>& tried)
{
    if (job.shadow_map.cull != scene::Cull::none) {
        tried.push_back({job, {"shadow_map.cull = \"none\""}});
        tried.back().job.shadow_map.cull = scene::Cull::none;
    }
    const scene::FrustumSettings& frustum = job.shadow_map.frustum;
    if (frustum.fit != scene::Fit::scene || frustum.near_m || frustum.far_m) {
        tried.push_back({job,
                         {"shadow_map.fit = \"scene\"", "shadow_map.near = \"auto\"",
                          "shadow_map.far = \"auto\""}});
        scene::FrustumSettings& wider = tried.back().job.shadow_map.frustum;
        wider.fit = scene::Fit::scene;
        wider.near_m.reset();
        wider.far_m.reset();
    }
}

/// The map of the job with what the causes of its errors call for.
std::vector<Variant> variants(const Job& job, const CauseLayers& causes)
{
    std::vector<Variant> tried;
    if (has(causes, Cause::bias) || has_coarse_texels(causes) || has(causes, Cause::precision)) {
        tried.push_back({job, {}}); // another bias may do
    }
    if (has(causes, Cause::bias) && job.bias.slope != 0) {
        tried.push_back({job, {"bias.slope = 0"}});
        tried.back().job.bias.slope = 0;
    }
    if (has(causes, Cause::bias) && job.bias.normal_texels != 0) {
        tried.push_back({job, {"bias.normal_texels = 0"}});
        tried.back().job.bias.normal_texels = 0;
    }
    const int resolution = 2 * job.shadow_map.resolution_texels;
    if (has_coarse_texels(causes) && resolution <= largest_resolution_texels) {
        tried.push_back({job, {fmt::format("shadow_map.resolution = {}", resolution)}});
        tried.back().job.shadow_map.resolution_texels = resolution;
    }
    if (has(causes, Cause::precision) && !job.shadow_map.depth_format.is_float()) {
        tried.push_back({job, {"shadow_map.depth_format = \"d32f\""}});
        tried.back().job.shadow_map.depth_format = {scene::DepthFormat::Kind::d32f, 32};
    }
    if (has(causes, Cause::coverage)) {
        add_wider_maps(job, tried);
    }
    return tried;
}

class Adviser {
public:
    Adviser(const Comparison& comparison, const scene::SceneFile& file, const Renderers& renderers)
        : comparison_{comparison},
          file_{file},
          renderers_{renderers}
    {
    }

    std::vector<Advice> run(const CauseLayers& causes)
    {
        for (const Variant& variant : variants(comparison_.job, causes)) {
            try_variant(variant);
        }
        return std::move(advice_);
    }

private:
    void try_variant(const Variant& variant)
    {
        scene::View view = scene::resolve_view(variant.job, file_.scene, file_.defaults);
        renderers_.draw_receivers(view);
        renderers_.draw_shadow_map(variant.job, view);
        const BiasSearch search{
            variant.job, view, {file_.scene, comparison_.receivers, comparison_.truth}, renderers_};
        if (!variant.keys.empty()) {
            measure_with(search, variant.job, view, variant.keys);
        }
        TunedSetting best{.map = variant.job.shadow_map, .slope = double{view.bias.slope}};
        search.find_constant({.max_shadow_amount_rate = 1, .max_light_amount_rate = 1}, best);
        view.bias.constant = best.constant;
        std::vector<std::string> keys = variant.keys;
        keys.push_back(fmt::format("bias.constant = {}", best.constant));
        measure_with(search, variant.job, view, std::move(keys));
    }

    void measure_with(const BiasSearch& search, const Job& job, const scene::View& view,
                      std::vector<std::string> keys)
    {
        const scene::LookupLayers own = renderers_.look_up(job, view);
        const Metrics metrics =
            measure(comparison_.truth, own, scene::promises(job.lookup.filter).equal_taps());
        advice_.push_back({std::move(keys),
                           {metrics.false_shadow, metrics.false_lit},
                           metrics.error_rate,
                           metrics.amounts,
                           search.softening_of(own, view.bias)});
    }

    const Comparison& comparison_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    std::vector<Advice> advice_;
};

} // namespace

std::vector<Advice> advise(const Comparison& comparison, const scene::SceneFile& file,
                           const Renderers& renderers)
{
    if (!comparison.diagnosis) {
        throw std::invalid_argument("advise: comparison: it has no diagnosis");
    }
    return Adviser{comparison, file, renderers}.run(comparison.diagnosis->causes);
}

} // namespace gnomon::analysis
