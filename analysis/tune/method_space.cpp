#include "analysis/tune/method_space.hpp"

#include "analysis/tune/tune_space.hpp"
#include "methods/job_method.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::analysis {

using scene::DepthFormat;
using scene::Job;
using scene::JobValue;
using scene::Key;

namespace {

constexpr int resolution_step_texels = 16;
/// The most slopes that `slopes` returns: 0, the job's own, and five.
constexpr std::size_t most_slopes = 7;

std::vector<DepthFormat> method_formats(const Job& job)
{
    using Kind = DepthFormat::Kind;
    std::vector<DepthFormat> formats{job.shadow_map.depth_format};
    for (const DepthFormat format :
         {scene::float_depth_format, DepthFormat{Kind::d24, 24}, DepthFormat{Kind::d16, 16}}) {
        if (format != formats.front()) {
            formats.push_back(format);
        }
    }
    return formats;
}

Job with_resolution(Job job, int resolution_texels)
{
    job.shadow_map.resolution_texels = resolution_texels;
    return job;
}

/// Rounds to two digits, as people type.
double typed(double number)
{
    return std::stod(fmt::format("{:.2g}", number));
}

/// The setting with each other value of one of its members.
/// @param member  Gives a reference to the member of a setting.
template <typename Values, typename Member>
std::vector<TunedSetting> with_others(const TunedSetting& from, const Values& values,
                                      const Member& member)
{
    std::vector<TunedSetting> others;
    for (const auto& value : values) {
        if (value != member(from)) {
            others.push_back(from);
            member(others.back()) = value;
        }
    }
    return others;
}

bool is_added_of(const Key& key, std::string_view table, std::string_view method)
{
    return key.is_added() && key.table() == table && key.is_of(method);
}

/// The job's values of the method's keys and its bias terms.
scene::MethodSettings own_method_settings(const Job& job, const std::string& method)
{
    scene::MethodSettings own{method, {}};
    for (const auto& [key, value] : job.method.values) {
        const Key* row = scene::keys_of(job).find(key);
        if (row != nullptr && row->is_of(method)) {
            own.values.emplace(key, value);
        }
    }
    return own;
}

} // namespace

int largest_resolution(const Job& job, const MapBudget& budget)
{
    const auto bytes = [&](int texels) {
        return methods::traits(with_resolution(job, texels)).map_bytes;
    };
    const int own = job.shadow_map.resolution_texels;
    if (!methods::traits(job).has_map) {
        return own;
    }
    const auto fits = [&](int texels) {
        return texels <= budget.max_resolution_texels && bytes(texels) <= budget.max_bytes;
    };
    int low = 0;                                                          // in steps; fits
    int high = budget.max_resolution_texels / resolution_step_texels + 1; // does not fit
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (fits(middle * resolution_step_texels) ? low : high) = middle;
    }
    int largest = low * resolution_step_texels;
    if (job.shadow_map.cascades.fit == scene::CascadeFit::stabilised &&
        scene::map_layout(job) == scene::MapLayout::cascades) {
        largest = static_cast<int>(std::bit_floor(static_cast<unsigned>(largest)));
    }
    return own > largest && fits(own) ? own : largest;
}

std::vector<JobValue> tried_values(const Key& key, double diagonal_m, double texel_width_m)
{
    const scene::TriedValues& tried = key.tried;
    std::vector<JobValue> values{*key.default_value};
    for (const JobValue& value : tried.values) {
        const auto* const number = std::get_if<double>(&value);
        if (number == nullptr || tried.unit == scene::TriedUnit::of_key) {
            values.push_back(value);
        } else {
            const double unit_m =
                tried.unit == scene::TriedUnit::scene_diagonals ? diagonal_m : texel_width_m;
            values.emplace_back(typed(*number * unit_m));
        }
    }
    return values;
}

MethodSpace::MethodSpace(const Job& job, const std::string& method, const scene::SceneFile& file,
                         const CheckedViews& views, const MapBudget& budget)
    : job_{job},
      method_{method},
      file_{file},
      views_{views},
      budget_{budget}
{
    add_map_axes();
    add_added_axes("method");
    add_lookup_axes();
    add_added_axes("bias");
    add_culls();
}

bool MethodSpace::has(std::string_view key) const
{
    return scene::keys_of(job_).has_key(method_, key);
}

void MethodSpace::add_map_axes()
{
    if (!has("shadow_map.resolution")) {
        return;
    }
    const std::vector<DepthFormat> formats = method_formats(job_);
    axes_.push_back({[formats](const TunedSetting& from) {
                         return with_others(
                             from, formats,
                             [](auto& setting) -> auto& { return setting.map.depth_format; });
                     },
                     formats.size() - 1});
    const std::vector<MapShape> shapes = distinct_shapes(job_, file_, views_);
    axes_.push_back({[shapes](const TunedSetting& from) {
                         std::vector<TunedSetting> others;
                         for (const MapShape& shape : shapes) {
                             others.push_back(from);
                             others.back().map.frustum = shape.frustum;
                             others.back().map.cascades = shape.cascades;
                             others.back().map.cascades.count = from.map.cascades.count;
                         }
                         return others;
                     },
                     shapes.size()});
    if (scene::map_layout(scene::with_layout(job_, file_.defaults)) == scene::MapLayout::cascades) {
        const std::set<int> counts{2, 3, 4, job_.shadow_map.cascades.count};
        axes_.push_back({[counts](const TunedSetting& from) {
                             return with_others(
                                 from, counts,
                                 [](auto& setting) -> auto& { return setting.map.cascades.count; });
                         },
                         counts.size() - 1});
    }
}

void MethodSpace::add_lookup_axes()
{
    std::vector<scene::Filter> filters;
    std::ranges::transform(methods::find_method(method_)->filters, std::back_inserter(filters),
                           &methods::FilterChoice::filter);
    if (!filters.empty()) {
        axes_.push_back({[filters](const TunedSetting& from) {
                             return with_others(
                                 from, filters,
                                 [](auto& setting) -> auto& { return setting.filter; });
                         },
                         filters.size() - 1});
    }
    if (!has("bias.constant")) {
        return;
    }
    const std::set<double> offsets{0, 1, 2, job_.bias.normal_texels};
    axes_.push_back({[offsets](const TunedSetting& from) {
                         return with_others(
                             from, offsets,
                             [](auto& setting) -> auto& { return setting.normal_texels; });
                     },
                     offsets.size() - 1});
    axes_.push_back({[this](const TunedSetting& from) {
                         const auto all = slopes(tuned_job(job_, from), from.filter,
                                                 first_map(from), from.map.resolution_texels);
                         return with_others(
                             from, all, [](auto& setting) -> auto& { return setting.slope; });
                     },
                     most_slopes});
}

void MethodSpace::add_added_axes(std::string_view table)
{
    for (const Key& key : scene::keys_of(job_).rows()) {
        if (!is_added_of(key, table, method_) || key.tried.values.empty()) {
            continue;
        }
        axes_.push_back({[this, &key](const TunedSetting& from) {
                             std::vector<TunedSetting> others;
                             for (const JobValue& value : values_of(key, from)) {
                                 if (value != key.value_of(*from.method)) {
                                     others.push_back(from);
                                     set_key(*others.back().method, key, value);
                                 }
                             }
                             return others;
                         },
                         key.tried.values.size() + 1});
    }
}

void MethodSpace::add_culls()
{
    if (!has("shadow_map.cull")) {
        return;
    }
    axes_.push_back(
        {[](const TunedSetting& from) {
             constexpr std::array culls{scene::Cull::none, scene::Cull::front, scene::Cull::back};
             return with_others(
                 from, culls, [](auto& setting) -> auto& { return setting.map.cull; });
         },
         2});
}

/// Sets a key, but drops a default that the job does not write out.
void MethodSpace::set_key(scene::MethodSettings& method, const Key& key,
                          const JobValue& value) const
{
    if (value == key.default_value && !job_.method.values.contains(key.name)) {
        method.values.erase(key.name);
    } else {
        method.values[key.name] = value;
    }
}

scene::LightFrustum MethodSpace::first_map(const TunedSetting& setting) const
{
    const Job seen = with_view_of(tuned_job(job_, setting), views_.own().view.job);
    return scene::resolve_view(seen, file_.scene, file_.defaults).first_map();
}

std::vector<JobValue> MethodSpace::values_of(const Key& key, const TunedSetting& from) const
{
    const bool counts_texels = key.tried.unit == scene::TriedUnit::texel_widths;
    const double texel_width_m =
        counts_texels ? first_map(from).texel_width_m(views_.own().median_light_distance_m,
                                                      from.map.resolution_texels)
                      : 0;
    return tried_values(key, file_.scene.bounds().diagonal_m(), texel_width_m);
}

TunedSetting MethodSpace::fitted(TunedSetting setting) const
{
    setting.bias = {};
    // The job's own side may exceed others of equal bytes if it is not a multiple of 16.
    setting.map.resolution_texels = job_.shadow_map.resolution_texels;
    setting.map.resolution_texels = largest_resolution(tuned_job(job_, setting), budget_);
    setting.cost = lookup_cost(tuned_job(job_, setting));
    return setting;
}

std::vector<TunedSetting> MethodSpace::starts() const
{
    TunedSetting own{job_.shadow_map, job_.lookup.filter, 0, 0, {}, {}, {}};
    own.map.layout = scene::map_layout(scene::with_layout(job_, file_.defaults));
    own.has_filter = !methods::find_method(method_)->filters.empty();
    own.method = own_method_settings(job_, method_);
    own.keys = scene::key_table_of(job_);
    if (has("bias.constant")) {
        own.slope = job_.bias.slope;
        own.normal_texels = job_.bias.normal_texels;
    }
    TunedSetting unbiased = own;
    unbiased.slope = 0;
    unbiased.normal_texels = 0;
    for (const Key& key : scene::keys_of(job_).rows()) {
        if (is_added_of(key, "bias", method_)) {
            set_key(*unbiased.method, key, *key.default_value);
        }
    }
    std::vector<TunedSetting> starts;
    for (const TunedSetting& with_biases : {own, unbiased}) {
        for (const scene::Cull cull : {own.map.cull, scene::Cull::none}) {
            for (const DepthFormat format : method_formats(job_)) {
                TunedSetting start = with_biases;
                start.map.cull = cull;
                start.map.depth_format = format;
                starts.push_back(fitted(std::move(start)));
            }
        }
    }
    return starts;
}

std::vector<TunedSetting> MethodSpace::along(std::size_t axis, const TunedSetting& from) const
{
    std::vector<TunedSetting> others = axes_[axis].others(from);
    std::ranges::transform(others, others.begin(),
                           [&](TunedSetting& other) { return fitted(std::move(other)); });
    return others;
}

std::size_t MethodSpace::most_settings(std::size_t rounds) const
{
    std::size_t values = 0;
    for (const Axis& axis : axes_) {
        values += axis.most;
    }
    return 1 + rounds * values;
}

} // namespace gnomon::analysis
