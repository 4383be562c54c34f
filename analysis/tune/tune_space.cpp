#include "analysis/tune/tune_space.hpp"

#include "analysis/advice/map_fit.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

namespace gnomon::analysis {

using scene::DepthFormat;
using scene::Filter;
using scene::Fit;
using scene::Job;

namespace {

constexpr int smallest_map_texels = 256;

bool is_same_shape(const MapShape& a, const MapShape& b)
{
    return a.frustum.fit == b.frustum.fit && a.frustum.near_m == b.frustum.near_m &&
           a.frustum.far_m == b.frustum.far_m && a.cascades.split == b.cascades.split &&
           a.cascades.split_lambda == b.cascades.split_lambda && a.cascades.fit == b.cascades.fit;
}

/// Tight and stabilised cascades with other λ.
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

/// `reach_of_shadows_m` of a view, with a fixed map.
double reach_in_view_m(const Job& job, const scene::SceneFile& file, const CheckedView& judged)
{
    Job fixed = with_view_of(job, judged.view.job);
    fixed.shadow_map.frustum.fit = Fit::fixed;
    return reach_of_shadows_m(file.scene, scene::resolve_view(fixed, file.scene, file.defaults),
                              judged.receivers.triangle, judged.truth.pixel_class);
}

/// Whether the job is valid in every view.
bool makes_maps(const Job& job, const scene::SceneFile& file, const CheckedViews& views)
{
    try {
        methods::check(job);
        for (const CheckedView& judged : views.views) {
            (void)scene::resolve_view(with_view_of(job, judged.view.job), file.scene,
                                      file.defaults);
        }
    } catch (const scene::InputError&) {
        return false;
    }
    return true;
}

} // namespace

std::vector<DepthFormat> tuned_formats(const Job& job)
{
    using Kind = DepthFormat::Kind;
    std::vector<DepthFormat> tried{{Kind::d16, 16}, {Kind::d24, 24}, scene::float_depth_format};
    if (std::ranges::find(tried, job.shadow_map.depth_format) == tried.end()) {
        tried.push_back(job.shadow_map.depth_format);
    }
    std::ranges::stable_sort(tried, {}, [&](const DepthFormat& format) {
        Job formatted = job;
        formatted.shadow_map.depth_format = format;
        return methods::traits(formatted).map_bytes;
    });
    return tried;
}

std::vector<int> tuned_resolutions(const Job& job, int most_texels)
{
    const int most = scene::map_count(job) > 1 ? most_texels / 2 : most_texels;
    std::set<int> texels;
    for (int size = smallest_map_texels; size <= most; size *= 2) {
        texels.insert(size);
    }
    if (job.shadow_map.resolution_texels <= most_texels) {
        texels.insert(job.shadow_map.resolution_texels);
    }
    return {texels.rbegin(), texels.rend()};
}

Job with_shape(Job job, const MapShape& shape)
{
    job.shadow_map.frustum = shape.frustum;
    job.shadow_map.cascades = shape.cascades;
    if (shape.layout) {
        job.shadow_map.layout = shape.layout;
    }
    return job;
}

std::optional<double> half_extent_of_shadows_m(const Job& job, const scene::SceneFile& file,
                                               const CheckedViews& views)
{
    if (job.lookup.outside == scene::Outside::shadowed || views.turns_light) {
        return std::nullopt;
    }
    double reach_m = 0;
    for (const CheckedView& judged : views.views) {
        reach_m = std::max(reach_m, reach_in_view_m(job, file, judged));
    }
    Job whole = with_view_of(job, views.own().view.job);
    whole.shadow_map.frustum.fit = Fit::scene;
    return half_extent_m(reach_m,
                         scene::resolve_view(whole, file.scene, file.defaults).first_map());
}

std::vector<MapShape> shapes_of_sun(const Job& job, const scene::SceneFile& file,
                                    const CheckedViews& views)
{
    std::vector<MapShape> shapes;
    const Job seen = with_view_of(job, views.own().view.job);
    if (scene::is_positional(seen.light->type) ||
        scene::map_layout(seen) != scene::MapLayout::single) {
        return shapes;
    }
    MapShape fitted{job.shadow_map.frustum, job.shadow_map.cascades};
    fitted.frustum.near_m.reset();
    fitted.frustum.far_m.reset();
    if (const auto half_m = half_extent_of_shadows_m(job, file, views)) {
        shapes.push_back(fitted);
        shapes.back().frustum.fit = Fit::fixed;
        shapes.back().frustum.half_extent_m = *half_m;
    }
    for (const int count : {4, 2}) {
        for (const double lambda : {0.5, 0.9}) {
            MapShape shape = fitted;
            shape.frustum.fit = Fit::scene;
            shape.layout = scene::MapLayout::cascades;
            shape.cascades.count = count;
            shape.cascades.fit = scene::CascadeFit::tight;
            shape.cascades.split = scene::CascadeSplit::practical;
            shape.cascades.split_lambda = lambda;
            shapes.push_back(shape);
        }
    }
    std::erase_if(shapes, [&](const MapShape& shape) {
        return !makes_maps(with_shape(job, shape), file, views);
    });
    return shapes;
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
                                      const CheckedViews& views)
{
    std::vector<MapShape> distinct;
    std::vector<std::vector<scene::Mat4f>> known;
    for (const MapShape& shape : map_shapes(job)) {
        std::vector<scene::Mat4f> matrices;
        try {
            for (const CheckedView& judged : views.views) {
                Job seen = with_view_of(job, judged.view.job);
                seen.shadow_map.frustum = shape.frustum;
                seen.shadow_map.cascades = shape.cascades;
                for (const scene::LightFrustum& map :
                     scene::resolve_view(seen, file.scene, file.defaults).maps) {
                    matrices.push_back(map.light_clip_from_world);
                }
            }
        } catch (const scene::InputError&) {
            continue; // near and far contradict each other there
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
    if (traits_of(job.shadow_map.frustum.content).is_root() ||
        !traits_of(job.shadow_map.depth_format).has_means) {
        std::erase_if(filters, [&](Filter filter) { // a mean is refused
            return methods::traits(with_filter(job, filter)).compares ==
                   methods::Compares::mean_depth;
        });
    }
    std::ranges::stable_sort(filters, {}, [&](Filter filter) {
        return methods::traits(with_filter(job, filter)).tap_count();
    });
    return filters;
}

std::vector<double> normal_offsets(const Job& job, Filter filter)
{
    std::set<double> tried{0.0, 1.0, job.bias.normal_texels};
    if (!methods::traits(with_filter(job, filter)).has_fractions()) {
        tried.insert(2.0);
    }
    return {tried.begin(), tried.end()};
}

std::vector<double> slopes(const Job& job, Filter filter, const scene::LightFrustum& frustum,
                           int resolution_texels)
{
    // For a spot, at the geometric mean of near and far.
    const double light_distance_m = std::sqrt(std::abs(frustum.near_m * frustum.far_m));
    const methods::LookupTraits traits = methods::traits(with_filter(job, filter));
    const int width = footprint_width_texels(traits, frustum, resolution_texels, light_distance_m);
    const double depth = depth_per_footprint(frustum, resolution_texels, width, light_distance_m);
    std::set<double> tried{0.0, job.bias.slope};
    const std::vector<float> usual = default_slopes(depth);
    for (std::size_t i = 0; i < usual.size(); ++i) {
        if (!traits.has_fractions() || i == slope_of_footprint) {
            // Rounded as printed, to be exactly what is recommended.
            tried.insert(std::stod(fmt::format("{}", usual[i])));
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
