#include "analysis/tune/tune_space.hpp"

#include "analysis/bias/slope_curves.hpp"
#include "methods/list.hpp"
#include "scene/error.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace gnomon::analysis {

using scene::DepthFormat;
using scene::Filter;
using scene::Fit;
using scene::Job;

namespace {

bool is_same_shape(const MapShape& a, const MapShape& b)
{
    return a.frustum.fit == b.frustum.fit && a.frustum.near_m == b.frustum.near_m &&
           a.frustum.far_m == b.frustum.far_m && a.cascades.split == b.cascades.split &&
           a.cascades.split_lambda == b.cascades.split_lambda && a.cascades.fit == b.cascades.fit;
}

/// Tight and stabilised, split by other λ.
std::vector<MapShape> cascade_shapes(const MapShape& own)
{
    using scene::CascadeFit;
    std::vector<CascadeFit> fits{CascadeFit::tight};
    if (own.cascades.near_m && own.cascades.far_m) {
        fits.push_back(CascadeFit::stabilised);
    }
    std::vector<MapShape> shapes;
    for (const CascadeFit fit : fits) {
        MapShape shape = own;
        shape.cascades.fit = fit;
        shapes.push_back(shape);
        for (const double lambda : {0.5, 0.9}) {
            shape.cascades.split = scene::CascadeSplit::practical;
            shape.cascades.split_lambda = lambda;
            shapes.push_back(shape);
        }
    }
    return shapes;
}

/// 0 where the maps are no cascades.
std::set<int> cascade_counts(const Job& job)
{
    return scene::map_layout(job) == scene::MapLayout::cascades
               ? std::set<int>{2, 3, 4, job.shadow_map.cascades.count}
               : std::set<int>{0};
}

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
    std::vector<DepthFormat> tried{{Kind::d16, 16}, {Kind::d24, 24}, scene::float_depth_format};
    if (std::ranges::find(tried, job.shadow_map.depth_format) == tried.end()) {
        tried.push_back(job.shadow_map.depth_format);
    }
    return tried;
}

} // namespace

std::vector<MapSize> map_sizes(const Job& job, const TuneLimits& limits)
{
    std::vector<MapSize> sizes;
    for (const int resolution : resolutions(job, limits)) {
        for (const int cascades : cascade_counts(job)) {
            for (const DepthFormat format : formats(job)) {
                Job sized = job;
                sized.shadow_map.resolution_texels = resolution;
                sized.shadow_map.depth_format = format;
                if (cascades > 0) {
                    sized.shadow_map.cascades.count = cascades;
                }
                sizes.push_back({resolution, format, cascades, methods::promises(sized).map_bytes});
            }
        }
    }
    std::ranges::stable_sort(sizes, {}, &MapSize::bytes);
    return sizes;
}

std::vector<MapShape> map_shapes(const Job& job)
{
    std::vector<MapShape> tried;
    const auto add = [&](const MapShape& shape) {
        if (std::ranges::none_of(
                tried, [&](const MapShape& known) { return is_same_shape(known, shape); })) {
            tried.push_back(shape);
        }
    };
    const MapShape own{job.shadow_map.frustum, job.shadow_map.cascades};
    MapShape fitted = own;
    fitted.frustum.near_m.reset();
    fitted.frustum.far_m.reset();
    add(own);
    add(fitted);
    if (scene::map_layout(job) == scene::MapLayout::cascades) {
        for (const MapShape& shape : cascade_shapes(fitted)) {
            add(shape);
        }
        return tried;
    }
    for (const Fit fit : {Fit::scene, Fit::camera}) {
        fitted.frustum.fit = fit;
        add(fitted);
    }
    return tried;
}

std::vector<MapShape> distinct_shapes(const Job& job, const scene::SceneFile& file,
                                      const JudgedViews& views)
{
    std::vector<MapShape> distinct;
    std::vector<std::vector<scene::Mat4f>> known;
    for (const MapShape& shape : map_shapes(job)) {
        std::vector<scene::Mat4f> matrices;
        try {
            for (const JudgedView& judged : views.views) {
                Job seen = with_view_of(job, judged.view.job);
                seen.shadow_map.frustum = shape.frustum;
                seen.shadow_map.cascades = shape.cascades;
                for (const scene::LightFrustum& map :
                     scene::resolve_view(seen, file.scene, file.defaults).maps) {
                    matrices.push_back(map.light_clip_from_world);
                }
            }
        } catch (const scene::InputError&) {
            continue; // planes that do not go together there
        }
        if (std::ranges::find(known, matrices) == known.end()) {
            known.push_back(std::move(matrices));
            distinct.push_back(shape);
        }
    }
    return distinct;
}

bool can_be_stable(const scene::ShadowMapSettings& map)
{
    return map.cascades.fit != scene::CascadeFit::stabilised ||
           std::has_single_bit(static_cast<unsigned>(map.resolution_texels));
}

std::vector<scene::Cull> other_culls(const Job& job)
{
    std::vector<scene::Cull> culls{scene::Cull::none, scene::Cull::front, scene::Cull::back};
    std::erase(culls, job.shadow_map.cull);
    return culls;
}

std::vector<Filter> tuned_filters(const Job& job)
{
    if (methods::method_of(job).filters.empty()) {
        return {job.lookup.filter};
    }
    std::vector<Filter> filters{Filter::nearest, Filter::linear, Filter::pcf3, Filter::pcf5};
    if (std::ranges::find(filters, job.lookup.filter) == filters.end()) {
        filters.push_back(job.lookup.filter);
    }
    const bool has_distances = job.shadow_map.frustum.content == scene::MapContent::distance;
    if (has_distances || !traits_of(job.shadow_map.depth_format).has_means) {
        std::erase_if(filters, [&](Filter filter) { // a mean is refused
            return methods::promises(with_filter(job, filter)).compares ==
                   methods::Compares::mean_depth;
        });
    }
    std::ranges::stable_sort(filters, {}, [&](Filter filter) {
        return methods::promises(with_filter(job, filter)).tap_count();
    });
    return filters;
}

std::vector<double> normal_offsets(const Job& job, Filter filter)
{
    std::set<double> tried{0.0, 1.0, job.bias.normal_texels};
    if (!methods::promises(with_filter(job, filter)).has_fractions()) {
        tried.insert(2.0);
    }
    return {tried.begin(), tried.end()};
}

std::vector<double> slopes(const Job& job, Filter filter, const scene::LightFrustum& frustum,
                           int resolution_texels)
{
    // A spot's at the geometric mean of near and far.
    const double light_distance_m = std::sqrt(std::abs(frustum.near_m * frustum.far_m));
    const methods::Promises promises = methods::promises(with_filter(job, filter));
    const int width =
        footprint_width_texels(promises, frustum, resolution_texels, light_distance_m);
    const double depth = depth_per_footprint(frustum, resolution_texels, width, light_distance_m);
    std::set<double> tried{0.0, job.bias.slope};
    for (const float slope : default_slopes(depth)) {
        const bool is_the_unit = slope == static_cast<float>(depth);
        if (!promises.has_fractions() || is_the_unit) {
            // Printed with few digits, and then exactly what is recommended.
            tried.insert(std::stod(fmt::format("{:.4g}", slope)));
        }
    }
    return {tried.begin(), tried.end()};
}

Job with_filter(Job job, Filter filter)
{
    job.lookup.filter = filter;
    return job;
}

} // namespace gnomon::analysis
