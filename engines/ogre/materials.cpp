#include "materials.hpp"

#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreTextureUnitState.h>

namespace engine::ogre_adapter {
namespace {

constexpr const char* group = "General";

constexpr const char* receiver_vertex = R"(#version 150
uniform mat4 clip_from_object;
uniform mat4 map_from_object;
in vec4 vertex;
out vec3 world;
out vec4 in_map;
void main()
{
    gl_Position = clip_from_object * vertex;
    world = vertex.xyz;
    in_map = map_from_object * vertex;
})";

// V is also 1 behind the light's camera, where OGRE does no lookup.
constexpr const char* receiver_fragment = R"(#version 150
#define PSSM_SAMPLE_CMP
vec4 shadow2D(sampler2DShadow map, vec3 place) { return vec4(texture(map, place)); }
#include <OgreUnifiedShader.h>
#include <SGXLib_IntegratedPSSM.glsl>
uniform sampler2DShadow shadow_map;
uniform vec4 inverse_size;
uniform float is_shadowed;
in vec3 world;
in vec4 in_map;
out vec4 seen;
void main()
{
    float visible = 1.0;
    if (is_shadowed > 0.5 && in_map.w > 0.0)
        SGX_ShadowPCF4(shadow_map, in_map, inverse_size.xy, visible);
    seen = vec4(world, visible);
})";

constexpr const char* caster_vertex = R"(#version 150
uniform mat4 clip_from_object;
in vec4 vertex;
void main() { gl_Position = clip_from_object * vertex; })";

constexpr const char* caster_fragment = R"(#version 150
out vec4 unused;
void main() { unused = vec4(1.0); })";

void make_program(const char* name, Ogre::GpuProgramType type, const char* source)
{
    const Ogre::HighLevelGpuProgramPtr program =
        Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, group, "glsl", type);
    program->setSource(source);
    program->load();
}

Ogre::MaterialPtr make_caster()
{
    make_program("caster_vertex", Ogre::GPT_VERTEX_PROGRAM, caster_vertex);
    make_program("caster_fragment", Ogre::GPT_FRAGMENT_PROGRAM, caster_fragment);
    const Ogre::MaterialPtr caster = Ogre::MaterialManager::getSingleton().create("caster", group);
    Ogre::Pass* const pass = caster->getTechnique(0)->getPass(0);
    pass->setVertexProgram("caster_vertex");
    pass->setFragmentProgram("caster_fragment");
    pass->getVertexProgramParameters()->setNamedAutoConstant(
        "clip_from_object", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    return caster;
}

/// Adds the texture unit of a depth map as the RTShader system does.
void add_map(Ogre::Pass& pass)
{
    Ogre::TextureUnitState* const map = pass.createTextureUnitState();
    map->setContentType(Ogre::TextureUnitState::CONTENT_SHADOW);
    map->setTextureAddressingMode(Ogre::TextureUnitState::TAM_BORDER);
    map->setTextureBorderColour(Ogre::ColourValue::White);
    map->setTextureCompareEnabled(true);
    map->setTextureCompareFunction(Ogre::CMPF_LESS_EQUAL);
}

Ogre::CullingMode culling_of(const Json& engine)
{
    return engine.at("cullingMode") == "clockwise" ? Ogre::CULL_CLOCKWISE : Ogre::CULL_NONE;
}

} // namespace

Ogre::MaterialPtr make_material()
{
    make_program("receiver_vertex", Ogre::GPT_VERTEX_PROGRAM, receiver_vertex);
    make_program("receiver_fragment", Ogre::GPT_FRAGMENT_PROGRAM, receiver_fragment);
    const Ogre::MaterialPtr material =
        Ogre::MaterialManager::getSingleton().create("receiver", group);
    material->getTechnique(0)->setShadowCasterMaterial(make_caster());
    Ogre::Pass* const pass = material->getTechnique(0)->getPass(0);
    pass->setVertexProgram("receiver_vertex");
    pass->setFragmentProgram("receiver_fragment");
    add_map(*pass);
    const Ogre::GpuProgramParametersSharedPtr vertex = pass->getVertexProgramParameters();
    vertex->setNamedAutoConstant("clip_from_object",
                                 Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    vertex->setNamedAutoConstant("map_from_object",
                                 Ogre::GpuProgramParameters::ACT_TEXTURE_WORLDVIEWPROJ_MATRIX, 0);
    const Ogre::GpuProgramParametersSharedPtr fragment = pass->getFragmentProgramParameters();
    fragment->setNamedConstant("shadow_map", 0);
    fragment->setNamedAutoConstant("inverse_size",
                                   Ogre::GpuProgramParameters::ACT_INVERSE_TEXTURE_SIZE, 0);
    return material;
}

void set_material(Ogre::Material& material, const Json& engine)
{
    Ogre::Pass& pass = *material.getTechnique(0)->getPass(0);
    pass.setCullingMode(culling_of(engine));
    pass.getTextureUnitState(0)->setTextureFiltering(
        engine.at("filtering") == "bilinear" ? Ogre::TFO_BILINEAR : Ogre::TFO_NONE);
    pass.getFragmentProgramParameters()->setNamedConstant(
        "is_shadowed", engine.at("castShadows").get<bool>() ? 1.0F : 0.0F);
    Ogre::Pass& caster =
        *material.getTechnique(0)->getShadowCasterMaterial()->getTechnique(0)->getPass(0);
    caster.setCullingMode(culling_of(engine));
    caster.setDepthBias(engine.at("depthBias").get<float>(),
                        engine.at("depthBiasSlopeScale").get<float>());
}

} // namespace engine::ogre_adapter
