#include "analysis/tune.hpp"

#include "analysis/metrics.hpp"
#include "analysis/slope_curves.hpp"
#include "analysis/tune_search.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace gnomon::analysis {

using scene::DepthFormat;
using scene::Job;
using scene::View;

namespace {

/// Bytes of a texel: a whole number of GL's smallest formats; u-formats as if GL had them.
std::uint64_t texel_bytes(DepthFormat format)
{
    return format.bits <= 16 ? 2 : 4;
}

/// Resolutions to try: powers of two from 256 up, and the job's own.
std::set<int> resolutions(const Job& job, const TuneLimits& limits)
{
    std::set<int> texels;
    for (int size = 256; size <= limits.max_resolution_texels; size *= 2) {
        texels.insert(size);
    }
    if (job.shadow_map.resolution_texels <= limits.max_resolution_texels) {
        texels.insert(job.shadow_map.resolution_texels);
    }
    return texels;
}

std::vector<DepthFormat> formats(const Job& job)
{
    using Kind = DepthFormat::Kind;
    std::vector<DepthFormat> tried{{Kind::d16, 16}, {Kind::d24, 24}, {Kind::d32f, 32}};
    if (std::ranges::find(tried, job.shadow_map.depth_format) == tried.end()) {
        tried.push_back(job.shadow_map.depth_format);
    }
    return tried;
}

/// The job's frustum; and, where it sets near or far, the one that is fitted.
std::vector<scene::FrustumSettings> frusta(const Job& job)
{
    std::vector<scene::FrustumSettings> tried{job.shadow_map.frustum};
    if (tried[0].near_m || tried[0].far_m) {
        tried.push_back(tried[0]);
        tried.back().near_m.reset();
        tried.back().far_m.reset();
    }
    return tried;
}

/// Maps to try, by bytes; of as many bytes, the smaller resolution first.
std::vector<scene::ShadowMapSettings> maps(const Job& job, const TuneLimits& limits)
{
    std::vector<scene::ShadowMapSettings> tried;
    for (const int resolution : resolutions(job, limits)) {
        for (const DepthFormat format : formats(job)) {
            for (const scene::FrustumSettings& frustum : frusta(job)) {
                tried.push_back({resolution, format, frustum, job.shadow_map.cull});
            }
        }
    }
    std::ranges::stable_sort(tried, {},
                             [](const scene::ShadowMapSettings& map) { return map_bytes(map); });
    return tried;
}

/// Normal offsets to try [texels]: the usual ones, and the job's own.
std::set<double> normal_offsets(const Job& job)
{
    return {0.0, 1.0, 2.0, job.bias.normal_texels};
}

/// Slopes to try: the usual ones for a texel's size, a spot's at the geometric mean of near and
/// far; and the job's own.
std::set<double> slopes(const Job& job, const View& view, int resolution)
{
    const double zeta_m = std::sqrt(std::abs(view.frustum.near_m * view.frustum.far_m));
    const double depth = depth_per_footprint(view.frustum, resolution, job.lookup.filter, zeta_m);
    std::set<double> tried{job.bias.slope};
    for (const float slope : default_slopes(depth)) {
        // Printed with few digits, and then exactly what is recommended.
        tried.insert(std::stod(fmt::format("{:.4g}", slope)));
    }
    return tried;
}

class Tuner {
public:
    Tuner(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
          const TuneLimits& limits, const std::function<void(const TunedSetting&)>& progress)
        : job_{job},
          file_{file},
          renderers_{renderers},
          limits_{limits},
          progress_{progress}
    {
    }

    TuneResult run()
    {
        const auto tried = maps(job_, limits_);
        if (tried.empty()) {
            throw scene::InputError(
                fmt::format("--max-resolution {}: no shadow map is that small; allow at least 256",
                            limits_.max_resolution_texels));
        }
        const View view = scene::resolve_view(job_, file_.scene, file_.defaults);
        receivers_ = renderers_.draw_receivers(view);
        truth_ = renderers_.find_truth(view, receivers_);
        require_scored_pixels();
        TuneResult result;
        for (const scene::ShadowMapSettings& map : tried) {
            const bool is_larger = !result.considered.empty() &&
                                   map_bytes(map) > map_bytes(result.considered.back().map);
            if (is_larger && result.meets_limits) {
                break;
            }
            try_map(map, result);
        }
        result.measured = compare(tuned_job(job_, result.best()), file_, renderers_);
        return result;
    }

private:
    void require_scored_pixels() const
    {
        if (count_classes(truth_).scored() == 0) {
            throw scene::InputError("camera: nothing that it sees faces the light, so that no "
                                    "pixel is scored; aim it at lit or shadowed surfaces");
        }
    }

    void try_map(const scene::ShadowMapSettings& map, TuneResult& result)
    {
        Job job = job_;
        job.shadow_map = map;
        job.bias = {};
        View view = scene::resolve_view(job, file_.scene, file_.defaults);
        // The light's matrix, and with it the receivers' light coordinates, follow near and far.
        renderers_.draw_receivers(view);
        renderers_.draw_shadow_map(job, view);
        for (const double normal_texels : normal_offsets(job_)) {
            job.bias.normal_texels = normal_texels;
            view = scene::resolve_view(job, file_.scene, file_.defaults);
            const BiasSearch search{job, view, {file_.scene, receivers_, truth_}, renderers_};
            for (const double slope : slopes(job_, view, map.resolution_texels)) {
                consider(search, {.map = map, .slope = slope, .normal_texels = normal_texels},
                         result);
            }
        }
    }

    void consider(const BiasSearch& search, TunedSetting setting, TuneResult& result)
    {
        search.find_constant(limits_, setting);
        // Fewer bytes come first, and the search ends where the limits are met: what is compared
        // has as many bytes, or nothing has met the limits so far.
        if (result.considered.empty() || is_better(setting, result.best())) {
            result.recommended = result.considered.size();
            result.meets_limits = setting.meets_limits;
        }
        result.considered.push_back(setting);
        if (progress_) {
            progress_(setting);
        }
    }

    const Job& job_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    const TuneLimits& limits_;
    const std::function<void(const TunedSetting&)>& progress_;
    scene::ReceiverLayers receivers_;
    scene::TruthLayers truth_;
};

} // namespace

std::uint64_t map_bytes(const scene::ShadowMapSettings& map)
{
    const auto side = static_cast<std::uint64_t>(map.resolution_texels);
    return side * side * texel_bytes(map.depth_format);
}

bool is_better(const TunedSetting& a, const TunedSetting& b)
{
    if (a.meets_limits != b.meets_limits) {
        return a.meets_limits;
    }
    const auto order = [](const TunedSetting& setting) {
        return std::tuple{setting.error_amount(), setting.errors.total(), map_bytes(setting.map),
                          -setting.interval.width()};
    };
    return order(a) < order(b);
}

Job tuned_job(const Job& job, const TunedSetting& setting)
{
    Job tuned = job;
    tuned.shadow_map = setting.map;
    tuned.bias = {double{setting.constant}, std::nullopt, setting.slope, setting.normal_texels};
    return tuned;
}

TuneResult tune(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
                const TuneLimits& limits, const std::function<void(const TunedSetting&)>& progress)
{
    return Tuner{job, file, renderers, limits, progress}.run();
}

} // namespace gnomon::analysis
