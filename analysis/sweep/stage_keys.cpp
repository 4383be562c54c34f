#include "analysis/sweep/stage_keys.hpp"

#include "methods/job_method.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <string_view>

namespace gnomon::analysis {

namespace {

using scene::Stage;

bool has(scene::Stages stages, Stage stage)
{
    return (stages & static_cast<scene::Stages>(stage)) != 0;
}

/// Whether a key of the stage *lookup* decides what to do with the depths, not where they are.
bool is_of_method(std::string_view key)
{
    return key == "lookup.filter" || key.starts_with("method.");
}

/// The job's keys, by the first stage that each decides.
struct KeyParts {
    std::string scene;
    std::string light;
    std::string camera; ///< and image
    std::string frustum;
    std::string map; ///< without the format
    std::string format;
    std::string filtered; ///< of the map
    std::string place;    ///< of the lookup in the map
    std::string verdict;  ///< what the method does with the depths
    std::string slope;
    std::string constant;

    std::string& of(std::string_view key, scene::Stages stages)
    {
        if (has(stages, Stage::scene)) {
            return scene;
        }
        if (has(stages, Stage::truth)) {
            return key.starts_with("light.") ? light : camera;
        }
        if (has(stages, Stage::receivers)) {
            return frustum;
        }
        if (has(stages, Stage::shadow_map)) {
            return key == "shadow_map.depth_format" ? format : map;
        }
        if (has(stages, Stage::prefilter)) {
            return filtered;
        }
        if (has(stages, Stage::lookup)) {
            return is_of_method(key) ? verdict : place;
        }
        return key == "bias.slope" ? slope : constant;
    }
};

KeyParts sort_keys(const scene::Job& job)
{
    KeyParts parts;
    for (const scene::Key& row : scene::keys_of(job).rows()) {
        if (const auto value = row.get(job)) {
            std::string& part = parts.of(row.name, row.stages);
            part += row.name;
            part += '=';
            part += scene::to_toml(*value);
            part += '\n';
        }
    }
    return parts;
}

StageKeys keys_of(const scene::Job& job, bool looks_up_every_bias)
{
    const KeyParts parts = sort_keys(job);
    const bool has_cascades = scene::map_layout(job) == scene::MapLayout::cascades;
    const bool follows_camera = has_cascades || job.shadow_map.frustum.fit == scene::Fit::camera;
    const std::string bias = parts.slope + parts.constant;
    StageKeys keys;
    keys.scene = parts.scene;
    keys.light = keys.scene + parts.light;
    keys.camera = keys.scene + parts.camera;
    keys.truth = keys.light + parts.camera;
    keys.frustum = (follows_camera ? keys.truth : keys.light) + parts.frustum;
    const std::string placed = keys.truth + parts.frustum;
    const bool is_of_pixel = scene::lookup_position(job) == scene::LookupPosition::pixel;
    const bool has_map = methods::traits(job).has_map;
    // World positions serve every light.
    keys.receivers = is_of_pixel || !has_map ? keys.camera : placed;
    keys.texels = keys.frustum + parts.map;
    const methods::Passes passes = methods::passes(job);
    const std::string_view more = passes.draws_primitives ? "primitives\n" : "";
    keys.map = has_map ? keys.texels + parts.format + std::string{more} : std::string{};
    const bool is_filtered = !passes.prefilter.empty();
    keys.filtered = is_filtered ? keys.map + parts.filtered : std::string{};
    keys.exact = placed + parts.map + parts.place;
    keys.lookup = keys.exact + parts.format + parts.filtered + parts.verdict;
    keys.lookup += looks_up_every_bias ? bias : std::string{};
    // Then a curve's bias is another number in each map.
    if (scene::scales_bias(job)) {
        keys.lookup += scene::key_leaf(scene::bias_unit_of(job.bias).key);
        keys.lookup += '\n';
    }
    keys.curve = keys.lookup + parts.slope;
    return keys;
}

} // namespace

StageKeys stage_keys(const scene::Job& job)
{
    return keys_of(job, !methods::traits(job).has_curve());
}

StageKeys stage_keys_with_bias(const scene::Job& job)
{
    return keys_of(job, true);
}

} // namespace gnomon::analysis
