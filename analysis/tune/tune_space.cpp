#include "analysis/tune/tune_space.hpp"

#include "analysis/bias/slope_curves.hpp"
#include "methods/list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace gnomon::analysis {

using scene::DepthFormat;
using scene::Filter;
using scene::Fit;
using scene::FrustumSettings;
using scene::Job;

namespace {

bool is_same_fit(const FrustumSettings& a, const FrustumSettings& b)
{
    return a.fit == b.fit && a.near_m == b.near_m && a.far_m == b.far_m;
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
        for (const DepthFormat format : formats(job)) {
            Job sized = job;
            sized.shadow_map.resolution_texels = resolution;
            sized.shadow_map.depth_format = format;
            sizes.push_back({resolution, format, methods::promises(sized).map_bytes});
        }
    }
    std::ranges::stable_sort(sizes, {}, &MapSize::bytes);
    return sizes;
}

std::vector<FrustumSettings> frusta(const Job& job)
{
    std::vector<FrustumSettings> tried;
    const auto add = [&](const FrustumSettings& frustum) {
        if (std::ranges::none_of(
                tried, [&](const FrustumSettings& known) { return is_same_fit(known, frustum); })) {
            tried.push_back(frustum);
        }
    };
    const FrustumSettings& own = job.shadow_map.frustum;
    add(own);
    for (const Fit fit : {own.fit, Fit::scene, Fit::camera}) {
        FrustumSettings fitted = own;
        fitted.fit = fit;
        fitted.near_m.reset();
        fitted.far_m.reset();
        add(fitted);
    }
    return tried;
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
    const double depth =
        depth_per_footprint(frustum, resolution_texels, promises.width_texels, light_distance_m);
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
