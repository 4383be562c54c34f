#include "scene/error.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/light/cascades.hpp"
#include "scene/settings/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::scene {
namespace {

/// Cascades follow the camera: receivers stay, but every map is redrawn.
constexpr Stages cascade_stages = Stage::receivers | Stage::shadow_map;
/// A slice that is blended everywhere would never give its own verdict.
constexpr double largest_blend = 0.999;
constexpr double least_view_depth_m = 1e-6;

/// Omitted unless the maps are cascades.
Key of_cascades(Key spec)
{
    spec.get = [get = std::move(spec.get)](const Job& job) {
        return map_layout(job) == MapLayout::cascades ? get(job) : std::nullopt;
    };
    return spec;
}

Key lambda_key()
{
    Key spec = member_key<double>(
        make_key("shadow_map.split_lambda",
                 "split = \"practical\": 0 splits uniformly, 1 logarithmically", "0.5",
                 cascade_stages),
        RealDomain{.lower = 0, .upper = 1},
        [](auto& job) -> auto& { return job.shadow_map.cascades.split_lambda; });
    spec.get = [get = std::move(spec.get)](const Job& job) {
        const bool is_asked = job.shadow_map.cascades.split == CascadeSplit::practical;
        return is_asked ? get(job) : std::nullopt;
    };
    return spec;
}

/// `cascade_near` or `cascade_far`: metres of view depth, or "auto".
Key view_depth_key(std::string name, std::string description,
                   std::optional<double> CascadeSettings::*depth)
{
    return number_or_auto_key(
        make_key(std::move(name), std::move(description), "\"auto\"", cascade_stages, "m"),
        RealDomain{.lower = least_view_depth_m, .upper = farthest_m, .or_auto = true},
        [depth](auto& job) -> auto& { return job.shadow_map.cascades.*depth; });
}

std::vector<Key> split_keys()
{
    return {member_key<std::int64_t>(
                make_key("shadow_map.cascades",
                         "how many slices the camera's view is split into, with a map each", "4",
                         cascade_stages),
                IntegerDomain{least_cascades, most_cascades},
                [](auto& job) -> auto& { return job.shadow_map.cascades.count; }),
            word_key<CascadeSplit>(
                make_key("shadow_map.split",
                         "where slices end: all equally deep, each deeper by the same factor, or "
                         "between the two, by split_lambda",
                         "\"practical\"", cascade_stages),
                3, cascade_split_name,
                [](auto& job) -> auto& { return job.shadow_map.cascades.split; }),
            lambda_key(),
            view_depth_key("shadow_map.cascade_near",
                           "view depth at which the first slice begins [{unit}]; auto: that of the "
                           "nearest receiver in view",
                           &CascadeSettings::near_m),
            view_depth_key("shadow_map.cascade_far",
                           "view depth at which the last slice ends [{unit}]; auto: that of the "
                           "farthest receiver in view",
                           &CascadeSettings::far_m)};
}

std::vector<Key> choice_keys()
{
    return {
        word_key<CascadeFit>(
            make_key("shadow_map.cascade_fit",
                     "what a map covers: the light-view box around its slice, or a sphere "
                     "around it, on a grid of texels that stands still in the world",
                     "\"tight\"", cascade_stages),
            2, cascade_fit_name, [](auto& job) -> auto& { return job.shadow_map.cascades.fit; }),
        word_key<CascadeSelect>(
            make_key("shadow_map.select",
                     "which cascade a receiver reads: that of its slice, or the first whose map "
                     "contains it",
                     "\"view_depth\"", only(Stage::lookup)),
            2, cascade_select_name,
            [](auto& job) -> auto& { return job.shadow_map.cascades.select; }),
        member_key<double>(
            make_key("shadow_map.blend",
                     "share of each slice, at its end, in which the next cascade's verdict is "
                     "mixed in",
                     "0", cascade_stages),
            RealDomain{.lower = 0, .upper = largest_blend},
            [](auto& job) -> auto& { return job.shadow_map.cascades.blend; })};
}

} // namespace

std::vector<Key> cascade_keys()
{
    std::vector<Key> specs;
    for (std::vector<Key> keys : {split_keys(), choice_keys()}) {
        for (Key& spec : keys) {
            specs.push_back(of_cascades(std::move(spec)));
        }
    }
    return specs;
}

bool is_cascade_key(std::string_view name)
{
    static const std::vector<Key> specs = cascade_keys();
    return std::ranges::any_of(specs, [&](const Key& spec) { return spec.name == name; });
}

} // namespace gnomon::scene
