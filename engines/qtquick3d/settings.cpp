#include "settings.hpp"

#include "cpp/request_validator.hpp"
#include "cpp/serve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>

namespace engine::qt_adapter {
namespace {

constexpr std::array sizes{256, 512, 1024, 2048}; // by shadowMapQuality

std::string cull_of(const Json& engine)
{
    return engine.at("cullMode") == "NoCulling" ? "none" : "back";
}

std::string content_of(LightType light)
{
    return light == LightType::directional ? "depth" : "linear";
}

/// Near and far of a directional light's map, from the position of Gnomon's map camera: the
/// bounding box of all objects, extended by a fortieth of its length on either side.
Json fitted_depths(const Json& order, const Scene& scene)
{
    const auto box = bounds(scene);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const Vector3 place{box[corner & 1U][0], box[corner >> 1U & 1U][1], box[corner >> 2U][2]};
        const double depth = dot(place, scene.light.direction);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const double margin = (farthest - nearest) / 40;
    const double from =
        dot(vector_of(order.at("light_camera").at("position")), scene.light.direction);
    return {{"near", nearest - margin - from}, {"far", farthest + margin - from}};
}

} // namespace

Json keys()
{
    return {
        number_key("shadowFactor", 0, 100, 5, "",
                   "the light's shadowFactor: light falls off by e to the minus factor times the "
                   "depth behind the map's"),
        number_key("shadowBias", -1, 1, 0, "depth",
                   "the light's shadowBias: is added to the depth that the map has; against acne "
                   "it is positive"),
        number_key("shadowFilter", 0, 100, 5, "",
                   "the light's shadowFilter: how far the map is blurred"),
        number_key("shadowMapFar", 2, 1e6, 5000, "units",
                   "the light's shadowMapFar: where the maps of spots and point lights end"),
        choice_key("cullMode", {"BackFaceCulling", "NoCulling"}, "BackFaceCulling",
                   "the material's cullMode: which faces are seen, and cast"),
        boolean_key("castsShadow", true, "the light's castsShadow: false draws no shadows"),
        number_key("unit_m", 1e-4, 10, 0.01, "m",
                   "what a unit is in the scene: maps of spots and point lights begin at 1 unit"),
    };
}

double units_per_metre(const Json& engine)
{
    return 1 / engine.at("unit_m").get<double>();
}

int cull_mode(const Json& engine)
{
    return engine.at("cullMode") == "NoCulling" ? 3 : 1; // Material.NoCulling, .BackFaceCulling
}

int quality_of(int resolution)
{
    return static_cast<int>(std::distance(sizes.begin(), std::ranges::find(sizes, resolution)));
}

void check(const Json& draw, LightType light)
{
    RequestValidator request{draw, "Qt Quick 3D"};
    if (std::ranges::find(sizes, draw.at("shadow_map").at("resolution").get<int>()) ==
        sizes.end()) {
        request.refuse("shadow_map.resolution",
                       "shadowMapQuality gives maps of 256, 512, 1024 or 2048 texels a side");
    }
    request.allow("shadow_map.layout", {light == LightType::point ? "cube" : "single"},
                  "a directional light has one map, others a cube's");
    request.allow("shadow_map.content", {content_of(light)},
                  "maps of spots and point lights hold distances, a directional light's depths");
    request.allow("shadow_map.reversed", {false}, "depths grow from the light here");
    request.allow("shadow_map.cull", {cull_of(draw.at("engine"))},
                  "engine.cullMode decides which faces cast");
    request.allow("lookup.position", {"pixel"}, "places in the map are made for each pixel");
    request.finish();
}

Json tables(const Json& draw, const Scene& scene)
{
    const LightType light = scene.light.type;
    const Json& engine = draw.at("engine");
    Json map{{"resolution", draw.at("shadow_map").at("resolution")},
             {"content", content_of(light)},
             {"reversed", false},
             {"cull", cull_of(engine)}};
    if (light != LightType::directional) {
        const double unit_m = engine.at("unit_m").get<double>();
        map["near"] = unit_m;
        map["far"] = unit_m * engine.at("shadowMapFar").get<double>();
    } else if (std::ranges::any_of(scene.objects, &SceneObject::casts)) {
        map.update(fitted_depths(draw.at("shadow_map"), scene));
    }
    return {{"shadow_map", map}, {"channels", {{"fractions", true}}}};
}

} // namespace engine::qt_adapter
