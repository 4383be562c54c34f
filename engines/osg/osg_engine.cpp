#include "osg_engine.hpp"

#include "graph.hpp"
#include "techniques.hpp"

#include <osg/LightSource>
#include <osg/Version>
#include <osgShadow/ShadowedScene>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace engine::osg_adapter {
namespace {

constexpr int most_map_texels = 16384; // osgShadow stores sizes as short

Json keys()
{
    return {
        choice_key("technique", technique_names(), technique_names().front(),
                   "osgShadow's technique: ShadowMap compares over 2 x 2 texels, SoftShadowMap "
                   "takes up to "
                   "64 jittered samples"),
        number_key(
            "polygonOffsetFactor", -1000, 1000, 1, "",
            "setPolygonOffset, x: GL gets its negative, so that what casts is drawn nearer to the "
            "light; against acne it is negative"),
        number_key("polygonOffsetUnits", -1e6, 1e6, 1, "depth steps",
                   "setPolygonOffset, y: GL gets its negative, too"),
        number_key("softnessWidth", 0, 1, 0.005, "map widths",
                   "setSoftnessWidth: how far SoftShadowMap's samples lie from the place"),
        number_key("jitteringScale", 1, 1024, 32, "px",
                   "setJitteringScale: how many pixels SoftShadowMap's jitter takes to repeat"),
        boolean_key("shadows", true,
                    "setAmbientBias: (0, 1), or if false (1, 0), by which what is looked up counts "
                    "for nothing"),
    };
}

osg::ref_ptr<osg::Group> make_root(const Scene& scene, osg::Group& objects,
                                   const osg::ref_ptr<osgShadow::ShadowedScene>& shadowed,
                                   bool is_lit)
{
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(make_light(scene.light));
    shadowed->addChild(source);
    shadowed->addChild(&objects);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(shadowed);
    osg::StateSet& state = *root->getOrCreateStateSet();
    const osg::StateAttribute::GLModeValue off = osg::StateAttribute::OFF;
    for (const GLenum mode : {GL_CULL_FACE, GL_BLEND, GL_DITHER}) {
        state.setMode(mode, off);
    }
    const osg::StateAttribute::GLModeValue on = osg::StateAttribute::ON;
    for (const GLenum mode : {GL_LIGHTING, GL_LIGHT0}) {
        state.setMode(mode, is_lit ? on : off);
    }
    return root;
}

/// Extracts `count` of each pixel's four numbers, from `first` on.
Floats part_of(const std::vector<float>& pixels, const Scene& scene, std::string name,
               std::size_t first, std::size_t count)
{
    Floats part{std::move(name), scene.width, scene.height, static_cast<int>(count), {}};
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        for (std::size_t k = first; k < first + count; ++k) {
            part.values.push_back(pixels[i + k]);
        }
    }
    return part;
}

/// The roll of the map's camera relative to Gnomon's, which has the world's y up [deg].
double roll_deg(const Vector3& forward, const Vector3& up)
{
    const Vector3 world_up{0, 1, 0};
    const bool is_vertical = length(cross(forward, world_up)) < 1e-3;
    const Vector3 right = normalized(cross(forward, is_vertical ? Vector3{0, 0, 1} : world_up));
    const Vector3 unrolled = cross(right, forward);
    return std::atan2(-dot(up, right), dot(up, unrolled)) * 180 / std::numbers::pi;
}

/// The map's coverage as job keys.
/// @param order  The draw's `shadow_map`, from whose camera a directional light's near and far
///               count.
Json coverage(const Json& order, LightType light, const osg::Camera& map)
{
    osg::Vec3d eye;
    osg::Vec3d centre;
    osg::Vec3d up;
    map.getViewMatrixAsLookAt(eye, centre, up);
    const Vector3 forward = normalized(vector_of(centre - eye));
    double near = 0;
    double far = 0;
    double unused = 0;
    if (light == LightType::directional) {
        double top = 0;
        map.getProjectionMatrixAsOrtho(unused, unused, unused, top, near, far);
        const double ahead = dot(
            vector_of(eye) - engine::vector_of(order.at("light_camera").at("position")), forward);
        return {{"near", near + ahead},
                {"far", far + ahead},
                {"fit", "fixed"},
                {"half_extent", top},
                {"roll_deg", roll_deg(forward, normalized(vector_of(up)))}};
    }
    double fov_deg = 0;
    map.getProjectionMatrixAsPerspective(fov_deg, unused, near, far);
    Json covered{{"near", near}, {"far", far}};
    if (light == LightType::spot) {
        covered.update({{"fit", "fixed"},
                        {"fov_deg", fov_deg},
                        {"roll_deg", roll_deg(forward, normalized(vector_of(up)))}});
    }
    return covered;
}

} // namespace

OsgEngine::OsgEngine(Mask mask) : mask_{mask}, depth_bits_{depth_bits()} {}

Identity OsgEngine::identity()
{
    return {"OpenSceneGraph", osgGetVersion(), context_.device(), keys()};
}

std::string OsgEngine::depth_format() const
{
    return std::string{"d"}.append(std::to_string(depth_bits_));
}

void OsgEngine::open(const Scene& scene)
{
    if (std::max(scene.width, scene.height) > context_.most_texels()) {
        throw Refusal{"the device draws at most " + std::to_string(context_.most_texels()) +
                      " pixels a side"};
    }
    scene_ = scene;
    view_.open(scene_);
    objects_ = make_objects(scene_, view_.camera());
}

void OsgEngine::check(const Json& draw) const
{
    RequestValidator request{draw, "OpenSceneGraph"};
    const bool is_soft = draw.at("engine").at("technique") != "ShadowMap";
    const int most = std::min(most_map_texels, context_.most_texels());
    if (draw.at("shadow_map").at("resolution").get<int>() > most) {
        request.refuse("shadow_map.resolution",
                       "maps have at most " + std::to_string(most) + " texels a side");
    }
    request.allow("shadow_map.layout", {"single"}, "a light has one map, a point light, too");
    request.allow("shadow_map.content", {"depth"}, "maps hold depths");
    request.allow("shadow_map.reversed", {false}, "depths grow from the light here");
    request.allow("shadow_map.depth_format", {depth_format()},
                  "osgShadow leaves the format to the driver");
    request.allow("shadow_map.cull", {"front"}, "osgShadow culls front faces in the map's pass");
    request.allow("lookup.outside", {"lit"}, "beyond the map all is lit");
    request.allow("lookup.position", {"vertex"}, "places in the map are made at the vertices");
    if (is_soft) {
        request.allow("lookup.filter", {}, "engine.technique filters as Gnomon has no name for");
    } else {
        request.allow("lookup.filter", {"hardware"}, "GL compares over 2 x 2 texels");
    }
    request.finish();
}

Json OsgEngine::tables(const Json& draw, const osg::Camera& map) const
{
    const Json& engine = draw.at("engine");
    Json made{{"shadow_map",
               {{"resolution", draw.at("shadow_map").at("resolution")},
                {"depth_format", depth_format()},
                {"reversed", false},
                {"cull", "front"}}},
              {"lookup", {{"outside", "lit"}}},
              {"bias",
               {{"constant", 0},
                {"slope", 0},
                {"normal_texels", 0},
                {"polygon_offset_factor", -engine.at("polygonOffsetFactor").get<double>()},
                {"polygon_offset_units", -engine.at("polygonOffsetUnits").get<double>()}}}};
    made["shadow_map"].update(coverage(draw.at("shadow_map"), scene_.light.type, map));
    if (scene_.light.type != LightType::point) {
        made["lookup"]["position"] = "vertex";
    }
    if (engine.at("technique") == "ShadowMap") {
        made["lookup"]["filter"] = "hardware";
    } else {
        made["channels"] = {{"fractions", true}};
    }
    return made;
}

std::vector<float> OsgEngine::render(const osg::ref_ptr<osgShadow::ShadowTechnique>& technique,
                                     bool is_lit)
{
    const osg::ref_ptr<osgShadow::ShadowedScene> shadowed = new osgShadow::ShadowedScene;
    shadowed->setReceivesShadowTraversalMask(is_drawn);
    shadowed->setCastsShadowTraversalMask(casts_shadow);
    shadowed->setShadowTechnique(technique);
    return view_.draw(make_root(scene_, *objects_, shadowed, is_lit), *technique);
}

std::vector<Floats> OsgEngine::picture(const Json& engine, int resolution)
{
    // Fixed functions light vertices, which would blur a spot's cone on large triangles.
    const bool is_lit = scene_.light.type != LightType::spot;
    Json off = engine;
    off["shadows"] = false;
    const std::vector<float> shadowed = render(make_own_technique(engine, resolution), is_lit);
    const std::vector<float> unshadowed = render(make_own_technique(off, resolution), is_lit);
    return mask_of_pictures(shadowed, unshadowed, scene_);
}

Drawn OsgEngine::draw(const Json& draw)
{
    check(draw);
    if (std::ranges::none_of(scene_.objects, &SceneObject::casts)) {
        throw Refusal{
            "osgShadow does not even clear a map into which nothing is drawn: its depths would be "
            "those of another frame; let an object cast"};
    }
    const int resolution = draw.at("shadow_map").at("resolution").get<int>();
    const Json& engine = draw.at("engine");
    const Technique technique = make_technique(engine, resolution);
    const std::vector<float> pixels = render(technique.technique, false);
    Drawn drawn;
    drawn.tables = tables(draw, *technique.camera(*technique.technique));
    drawn.files.push_back(part_of(pixels, scene_, "position", 0, 3));
    if (mask_ == Mask::picture) {
        drawn.tables["channels"] = {{"fractions", true}};
        std::ranges::move(picture(engine, resolution), std::back_inserter(drawn.files));
        return drawn;
    }
    drawn.files.push_back(part_of(pixels, scene_, "shadow", 3, 1));
    for (float& visible : drawn.files.back().values) {
        visible = std::isnan(visible) ? 0 : visible; // NaN: background
    }
    return drawn;
}

} // namespace engine::osg_adapter
