#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/job/setting_layers.hpp"
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

const double* number_of(const Settings& settings, std::string_view key)
{
    const Setting* setting = find_setting(settings, key);
    return setting == nullptr ? nullptr : std::get_if<double>(&setting->value);
}

bool is_word(const Settings& settings, std::string_view key, std::string_view word)
{
    const Setting* setting = find_setting(settings, key);
    return setting != nullptr && std::get<std::string>(setting->value) == word;
}

void check_stabilised(const Settings& settings)
{
    const Setting& fit = settings.at("shadow_map.cascade_fit");
    for (const std::string_view needed : {"shadow_map.cascade_near", "shadow_map.cascade_far"}) {
        if (number_of(settings, needed) == nullptr) {
            refuse(fit, fmt::format(
                            "needs shadow_map.cascade_near and shadow_map.cascade_far in metres, "
                            "so that the slices do not change with the view; {} is missing",
                            needed));
        }
    }
    const Setting* resolution = find_setting(settings, "shadow_map.resolution");
    if (resolution == nullptr) {
        return; // the default is a power of two
    }
    const auto texels = static_cast<std::uint64_t>(std::get<std::int64_t>(resolution->value));
    if (texels < 2 || !std::has_single_bit(texels)) {
        refuse(*resolution, fmt::format("must be a power of two, at least 2, so that float32 holds "
                                        "the texel grid of {} exactly",
                                        fit.label));
    }
}

} // namespace

void check_cascades(const Settings& settings)
{
    if (!is_word(settings, "shadow_map.layout", "cascades")) {
        for (const auto& [key, setting] : settings) {
            if (is_cascade_key(key)) {
                refuse(setting, "only for shadow_map.layout = \"cascades\"; set that too, or "
                                "remove this key");
            }
        }
        return;
    }
    const Setting* lambda = find_setting(settings, "shadow_map.split_lambda");
    if (lambda != nullptr && find_setting(settings, "shadow_map.split") != nullptr &&
        !is_word(settings, "shadow_map.split", "practical")) {
        refuse(*lambda, "only for shadow_map.split = \"practical\"; remove it, or set that: 0 "
                        "splits uniformly, 1 logarithmically");
    }
    const double* near_m = number_of(settings, "shadow_map.cascade_near");
    const double* far_m = number_of(settings, "shadow_map.cascade_far");
    if (near_m != nullptr && far_m != nullptr && !(*near_m < *far_m)) {
        refuse(settings.at("shadow_map.cascade_near"),
               fmt::format("must be less than shadow_map.cascade_far ({})",
                           settings.at("shadow_map.cascade_far").label));
    }
    if (is_word(settings, "shadow_map.cascade_fit", "stabilised")) {
        check_stabilised(settings);
    }
    const double* blend = number_of(settings, "shadow_map.blend");
    if (blend != nullptr && *blend > 0 && is_word(settings, "shadow_map.select", "containing")) {
        refuse(settings.at("shadow_map.blend"),
               "cascades are blended by view depth; set shadow_map.select = \"view_depth\", or "
               "remove this key");
    }
}

} // namespace gnomon::scene
