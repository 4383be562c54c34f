#include "ogre_engine.hpp"

#include "materials.hpp"
#include "shadow_camera.hpp"
#include "white_material.hpp"

#include <OgreCamera.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreLight.h>
#include <OgreLogManager.h>
#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreRenderSystem.h>
#include <OgreRenderTexture.h>
#include <OgreRenderWindow.h>
#include <OgreResourceGroupManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTextureManager.h>
#include <OgreViewport.h>
#include <RTShaderSystem/OgreShaderGenerator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace engine::ogre_adapter {
namespace {

constexpr unsigned is_drawn = 1;
constexpr unsigned only_casts = 2;
constexpr int most_texels = 16384;
constexpr double widening = 1.2; // a spot's map by its cone, from DefaultShadowCameraSetup
constexpr double widest_deg = 175;

Json keys()
{
    return {
        boolean_key("shadowCasterRenderBackFaces", true,
                    "setShadowCasterRenderBackFaces: back faces cast; false: the front ones"),
        choice_key("cullingMode", {"clockwise", "none"}, "clockwise",
                   "the material's culling_mode: none shows and casts both sides"),
        choice_key("filtering", {"bilinear", "none"}, "bilinear",
                   "the map's filtering: each of the four taps compares 2 x 2 texels, or one"),
        number_key("depthBias", -1e6, 1e6, -1, "depth steps",
                   "the caster's depth_bias: nearer to the light; against acne it is negative"),
        number_key(
            "depthBiasSlopeScale", -1000, 1000, -1, "",
            "the caster's depth_bias per slope: nearer to the light; against acne it is negative"),
        boolean_key("castShadows", true, "Light::setCastShadows: false draws no shadows"),
    };
}

Ogre::Vector3 ogre_vector(const Vector3& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// The unit normal of a corner's triangle; zeros for a degenerate one.
Ogre::Vector3 normal_at(const std::vector<float>& corners, std::size_t corner)
{
    const auto at = [&](std::size_t k) {
        const float* const place = &corners[corner - corner % 9 + 3 * k];
        return Ogre::Vector3{place[0], place[1], place[2]};
    };
    return (at(1) - at(0)).crossProduct(at(2) - at(0)).normalisedCopy();
}

void add_objects(Ogre::SceneManager& manager, const Scene& scene, const Ogre::MaterialPtr& material)
{
    for (const SceneObject& object : scene.objects) {
        const std::vector<float>& corners = object.shape.corners;
        Ogre::ManualObject* const made = manager.createManualObject();
        made->begin(material, Ogre::RenderOperation::OT_TRIANGLE_LIST);
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            made->position(corners[i], corners[i + 1], corners[i + 2]);
            made->normal(normal_at(corners, i));
        }
        made->end();
        made->setCastShadows(object.casts);
        made->setVisibilityFlags(object.is_seen ? is_drawn | only_casts : only_casts);
        manager.getRootSceneNode()->createChildSceneNode()->attachObject(made);
    }
}

void add_light(Ogre::SceneManager& manager, const Light& light, const Json& map, bool casts)
{
    Ogre::Light* const made = manager.createLight();
    Ogre::SceneNode* const node = manager.getRootSceneNode()->createChildSceneNode();
    node->attachObject(made);
    made->setCastShadows(casts);
    node->setDirection(ogre_vector(light.direction), Ogre::Node::TS_WORLD);
    if (light.type == LightType::directional) {
        made->setType(Ogre::Light::LT_DIRECTIONAL);
        manager.setShadowCameraSetup(place_as_told(map));
        return;
    }
    made->setType(Ogre::Light::LT_SPOTLIGHT);
    const Ogre::Radian cone{Ogre::Degree{static_cast<float>(light.cone_deg)}};
    made->setSpotlightRange(cone, cone);
    made->setAttenuation(map.at("far").get<float>() * 10, 1, 0, 0);
    made->setShadowNearClipDistance(map.at("near").get<float>());
    made->setShadowFarClipDistance(map.at("far").get<float>());
    node->setPosition(ogre_vector(light.position));
}

Ogre::Camera& add_camera(Ogre::SceneManager& manager, const Scene& scene)
{
    Ogre::Camera& camera = *manager.createCamera("camera");
    Ogre::SceneNode* const node = manager.getRootSceneNode()->createChildSceneNode();
    node->attachObject(&camera);
    const Planes planes = camera_planes(scene);
    const double aspect = static_cast<double>(scene.width) / scene.height;
    Vector3 eye = scene.camera.eye;
    camera.setAspectRatio(static_cast<float>(aspect));
    if (scene.camera.orthographic_height) {
        const double height = *scene.camera.orthographic_height;
        camera.setProjectionType(Ogre::PT_ORTHOGRAPHIC);
        camera.setOrthoWindow(static_cast<float>(height * aspect), static_cast<float>(height));
        // Near must be positive: move the camera back, so that it also sees objects behind the eye.
        eye = eye + planes.far * normalized(eye - scene.camera.target);
        camera.setNearClipDistance(static_cast<float>(planes.far * 1e-3));
        camera.setFarClipDistance(static_cast<float>(2 * planes.far));
    } else {
        camera.setFOVy(Ogre::Degree{static_cast<float>(*scene.camera.vertical_fov_deg)});
        camera.setNearClipDistance(static_cast<float>(planes.near));
        camera.setFarClipDistance(static_cast<float>(planes.far));
    }
    node->setPosition(ogre_vector(eye));
    const Vector3 backward = normalized(scene.camera.eye - scene.camera.target);
    node->setOrientation(
        Ogre::Math::lookRotation(ogre_vector(backward), ogre_vector(scene.camera.up)));
    return camera;
}

void set_shadows(Ogre::SceneManager& manager, const Json& draw)
{
    const Json& engine = draw.at("engine");
    manager.setShadowTextureSettings(draw.at("shadow_map").at("resolution").get<Ogre::uint16>(), 1,
                                     Ogre::PF_DEPTH32);
    manager.setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
    manager.setShadowCasterRenderBackFaces(engine.at("shadowCasterRenderBackFaces").get<bool>());
}

/// The culled faces of the map, in Gnomon's terms.
std::string cull_of(const Json& engine)
{
    if (engine.at("cullingMode") == "none") {
        return "none";
    }
    return engine.at("shadowCasterRenderBackFaces").get<bool>() ? "front" : "back";
}

void check(const Json& draw)
{
    RequestValidator request{draw, "OGRE"};
    if (draw.at("shadow_map").at("resolution").get<int>() > most_texels) {
        request.refuse("shadow_map.resolution", "maps have at most 16384 texels a side");
    }
    request.allow("shadow_map.layout", {"single"}, "a light has one map");
    request.allow("shadow_map.content", {"depth"}, "maps hold depths");
    request.allow("shadow_map.reversed", {false}, "depths grow from the light here");
    request.allow(
        "shadow_map.cull", {cull_of(draw.at("engine"))},
        "engine.cullingMode and engine.shadowCasterRenderBackFaces decide which faces cast");
    request.allow("lookup.outside", {"lit"}, "beyond the map all is lit");
    request.allow("lookup.position", {"vertex"}, "places in the map are made at the vertices");
    request.allow("lookup.filter", {}, "engine.filtering filters as Gnomon has no name for");
    request.finish();
}

Json tables(const Json& draw, const Light& light)
{
    const Json& map = draw.at("shadow_map");
    const Json& engine = draw.at("engine");
    Json table{{"resolution", map.at("resolution")},
               {"near", map.at("near")},
               {"far", map.at("far")},
               {"reversed", false},
               {"cull", cull_of(engine)}};
    if (light.type == LightType::spot) {
        table["fit"] = "fixed";
        table["fov_deg"] = std::min(widening * light.cone_deg, widest_deg);
    }
    return {{"shadow_map", table},
            {"lookup", {{"outside", "lit"}, {"position", "vertex"}}},
            {"channels", {{"fractions", true}}},
            {"bias",
             {{"constant", 0},
              {"slope", 0},
              {"normal_texels", 0},
              {"polygon_offset_factor", -engine.at("depthBiasSlopeScale").get<double>()},
              {"polygon_offset_units", -engine.at("depthBias").get<double>()}}}};
}

} // namespace

OgreEngine::OgreEngine(Mask mask) : mask_{mask}, log_{std::make_unique<Ogre::LogManager>()}
{
    log_->createLog("", true, false, true); // no log file, no terminal output
    root_ = std::make_unique<Ogre::Root>("", "", "");
    root_->loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root_->setRenderSystem(root_->getAvailableRenderers().front());
    root_->initialise(false);
    const Ogre::NameValuePairList hidden{{"hidden", "true"}};
    root_->createRenderWindow("gnomon", 16, 16, false, &hidden);
    Ogre::ResourceGroupManager& resources = Ogre::ResourceGroupManager::getSingleton();
    for (const char* const folder : {OGRE_MEDIA "/RTShaderLib/GLSL", OGRE_MEDIA "/ShadowVolume"}) {
        resources.addResourceLocation(folder, "FileSystem");
    }
    resources.initialiseAllResourceGroups();
    material_ = make_material();
    if (mask_ == Mask::picture && !Ogre::RTShader::ShaderGenerator::initialize()) {
        throw std::runtime_error{"OGRE's RTShader system does not start"};
    }
}

OgreEngine::~OgreEngine()
{
    target_.reset();
    material_.reset();
    if (mask_ == Mask::picture) {
        Ogre::RTShader::ShaderGenerator::destroy();
    }
    root_.reset();
}

Identity OgreEngine::identity()
{
    const std::string version = std::to_string(OGRE_VERSION_MAJOR) + "." +
                                std::to_string(OGRE_VERSION_MINOR) + "." +
                                std::to_string(OGRE_VERSION_PATCH);
    return {"OGRE", version, root_->getRenderSystem()->getCapabilities()->getDeviceName(), keys()};
}

void OgreEngine::open(const Scene& scene)
{
    if (scene.light.type == LightType::point) {
        throw Refusal{
            "a point light's map spans 120 degrees towards what the camera looks at, and no more: "
            "point lights are not driven"};
    }
    if (std::max(scene.width, scene.height) > most_texels) {
        throw Refusal{"images have at most 16384 pixels a side"};
    }
    scene_ = scene;
    Ogre::TextureManager& textures = Ogre::TextureManager::getSingleton();
    if (target_) {
        textures.remove(target_);
    }
    target_ = textures.createManual(
        "frame", "General", Ogre::TEX_TYPE_2D, static_cast<Ogre::uint>(scene.width),
        static_cast<Ogre::uint>(scene.height), 0, Ogre::PF_FLOAT32_RGBA, Ogre::TU_RENDERTARGET);
}

std::vector<float> OgreEngine::pixels_seen_by(Ogre::Camera& camera, const Ogre::String& scheme)
{
    Ogre::RenderTexture* const target = target_->getBuffer()->getRenderTarget();
    target->removeAllViewports();
    Ogre::Viewport* const view = target->addViewport(&camera);
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    view->setBackgroundColour(Ogre::ColourValue{nothing, nothing, nothing, nothing});
    view->setOverlaysEnabled(false);
    view->setVisibilityMask(is_drawn);
    view->setMaterialScheme(scheme);
    target->setAutoUpdated(false);
    target->update();
    std::vector<float> pixels(4 * static_cast<std::size_t>(scene_.width) *
                              static_cast<std::size_t>(scene_.height));
    target_->getBuffer()->blitToMemory({static_cast<Ogre::uint32>(scene_.width),
                                        static_cast<Ogre::uint32>(scene_.height), 1,
                                        Ogre::PF_FLOAT32_RGBA, pixels.data()});
    target->removeAllViewports();
    return pixels;
}

std::vector<float> OgreEngine::render(Ogre::SceneManager& manager, const Json& draw,
                                      const Ogre::MaterialPtr& material, const Ogre::String& scheme)
{
    add_objects(manager, scene_, material);
    add_light(manager, scene_.light, draw.at("shadow_map"),
              draw.at("engine").at("castShadows").get<bool>());
    return pixels_seen_by(add_camera(manager, scene_), scheme);
}

std::vector<float> OgreEngine::seen(const Json& draw)
{
    Ogre::SceneManager& manager = *root_->createSceneManager();
    set_shadows(manager, draw);
    const std::vector<float> pixels =
        render(manager, draw, material_, Ogre::MaterialManager::DEFAULT_SCHEME_NAME);
    root_->destroySceneManager(&manager);
    return pixels;
}

std::vector<float> OgreEngine::picture(const Json& draw, bool has_shadows)
{
    Ogre::SceneManager& manager = *root_->createSceneManager();
    if (has_shadows) {
        set_shadows(manager, draw);
    }
    std::vector<float> pixels;
    {
        const WhiteMaterial white{manager, scene_.light.type, *material_, has_shadows};
        pixels = render(manager, draw, white.material(), WhiteMaterial::scheme());
        manager.clearScene();
    }
    root_->destroySceneManager(&manager);
    return pixels;
}

Drawn OgreEngine::draw(const Json& draw)
{
    check(draw);
    const Json& engine = draw.at("engine");
    set_material(*material_, engine);
    const std::vector<float> pixels = seen(draw);
    Floats position{"position", scene_.width, scene_.height, 3, {}};
    Floats shadow{"shadow", scene_.width, scene_.height, 1, {}};
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        position.values.insert(position.values.end(), &pixels[i], &pixels[i + 3]);
        shadow.values.push_back(std::isnan(pixels[i + 3]) ? 0 : pixels[i + 3]);
    }
    if (mask_ == Mask::shader) {
        return {{std::move(position), std::move(shadow)}, tables(draw, scene_.light)};
    }
    std::vector<Floats> files = mask_of_pictures(
        picture(draw, engine.at("castShadows").get<bool>()), picture(draw, false), scene_);
    files.push_back(std::move(position));
    return {std::move(files), tables(draw, scene_.light)};
}

} // namespace engine::ogre_adapter
