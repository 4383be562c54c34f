#include "scene/settings/job.hpp"

#include "scene/light/cube_faces.hpp"

#include <array>

namespace gnomon::scene {
namespace {

constexpr std::array<std::string_view, 3> outside_names{"lit", "shadowed", "clamp"};
constexpr std::array<std::string_view, 2> position_names{"vertex", "pixel"};
constexpr std::array<std::string_view, 3> cull_names{"none", "front", "back"};
constexpr std::array<std::string_view, 3> layout_names{"single", "cube", "cascades"};
constexpr std::array<std::string_view, 3> fit_names{"scene", "camera", "fixed"};

} // namespace

std::string_view length_unit(const SceneSettings& scene)
{
    return scene.file.empty() || scene.unit_m ? "m" : "units";
}

std::string_view lookup_position_name(LookupPosition position)
{
    return position_names.at(static_cast<std::size_t>(position));
}

std::string_view outside_name(Outside outside)
{
    return outside_names.at(static_cast<std::size_t>(outside));
}

std::string_view cull_name(Cull cull)
{
    return cull_names.at(static_cast<std::size_t>(cull));
}

std::string_view fit_name(Fit fit)
{
    return fit_names.at(static_cast<std::size_t>(fit));
}

std::string_view map_layout_name(MapLayout layout)
{
    return layout_names.at(static_cast<std::size_t>(layout));
}

MapLayout map_layout(const Job& job)
{
    const bool is_point = job.light && shines_all_round(job.light->type);
    return job.shadow_map.layout.value_or(is_point ? MapLayout::cube : MapLayout::single);
}

std::size_t map_count(const Job& job)
{
    switch (map_layout(job)) {
    case MapLayout::single:
        return 1;
    case MapLayout::cube:
        return cube_face_count;
    case MapLayout::cascades:
        return static_cast<std::size_t>(job.shadow_map.cascades.count);
    }
    return 1;
}

bool scales_bias(const Job& job)
{
    return map_layout(job) == MapLayout::cascades && !bias_unit_of(job.bias).is_depth();
}

void set_constant(Job& job, const BiasUnit& unit, double value, double depth)
{
    set_constant(job.bias, unit, value);
    if (!scales_bias(job)) {
        set_constant(job.bias, bias_in_depth, depth);
    }
}

bool mixes_maps(const Job& job)
{
    return map_layout(job) == MapLayout::cascades && job.shadow_map.cascades.blend > 0;
}

LookupPosition lookup_position(const Job& job)
{
    return job.lookup.position.value_or(map_count(job) > 1 ? LookupPosition::pixel
                                                           : LookupPosition::vertex);
}

} // namespace gnomon::scene
