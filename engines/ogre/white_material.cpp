#include "white_material.hpp"

#include <RTShaderSystem/OgreRTShaderSystem.h>

#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreTechnique.h>
#include <OgreTextureUnitState.h>

#include <stdexcept>

namespace engine::ogre_adapter {
namespace {

using Ogre::RTShader::IntegratedPSSM3;
using Ogre::RTShader::PerPixelLighting;
using Ogre::RTShader::RenderState;
using Ogre::RTShader::ShaderGenerator;

constexpr const char* name = "white";

Ogre::Pass& pass_of(const Ogre::Material& material)
{
    return *material.getTechnique(0)->getPass(0);
}

/// Sets up per-pixel lighting by the only light, with or without its shadow.
void set_up_shaders(LightType light, bool is_shadowed)
{
    ShaderGenerator& generator = ShaderGenerator::getSingleton();
    RenderState& state = *generator.getRenderState(WhiteMaterial::scheme());
    state.reset();
    state.setLightCountAutoUpdate(false);
    const bool is_spot = light == LightType::spot;
    state.setLightCount({0, is_spot ? 0 : 1, is_spot ? 1 : 0});
    state.addTemplateSubRenderState(generator.createSubRenderState<PerPixelLighting>());
    if (is_shadowed) {
        auto* const lookup = generator.createSubRenderState<IntegratedPSSM3>();
        constexpr float everything = 1e6F; // one map at any distance from the camera
        lookup->setSplitPoints({0, everything});
        state.addTemplateSubRenderState(lookup);
    }
}

/// Copies the map's filtering from the adapter's material.
void copy_filtering(const Ogre::Pass& to, const Ogre::Pass& from)
{
    for (Ogre::TextureUnitState* const unit : to.getTextureUnitStates()) {
        unit->setTextureFiltering(from.getTextureUnitState(0)->getTextureFiltering(Ogre::FT_MIN),
                                  from.getTextureUnitState(0)->getTextureFiltering(Ogre::FT_MAG),
                                  from.getTextureUnitState(0)->getTextureFiltering(Ogre::FT_MIP));
    }
}

} // namespace

const Ogre::String& WhiteMaterial::scheme()
{
    return ShaderGenerator::DEFAULT_SCHEME_NAME;
}

WhiteMaterial::WhiteMaterial(Ogre::SceneManager& manager, LightType light,
                             const Ogre::Material& receiver, bool is_shadowed)
    : manager_{manager},
      material_{Ogre::MaterialManager::getSingleton().create(name, "General")}
{
    pass_of(*material_).setCullingMode(pass_of(receiver).getCullingMode());
    material_->getTechnique(0)->setShadowCasterMaterial(
        receiver.getTechnique(0)->getShadowCasterMaterial());
    ShaderGenerator& generator = ShaderGenerator::getSingleton();
    generator.addSceneManager(&manager_);
    generator._setActiveSceneManager(&manager_);
    set_up_shaders(light, is_shadowed);
    if (!generator.createShaderBasedTechnique(
            *material_, Ogre::MaterialManager::DEFAULT_SCHEME_NAME, scheme()) ||
        !generator.validateMaterial(scheme(), name, "General")) {
        throw std::runtime_error{"OGRE's RTShader system writes no shaders for its white material"};
    }
    for (const Ogre::Technique* const technique : material_->getTechniques()) {
        if (technique->getSchemeName() == scheme()) {
            copy_filtering(*technique->getPass(0), pass_of(receiver));
        }
    }
}

WhiteMaterial::~WhiteMaterial()
{
    ShaderGenerator& generator = ShaderGenerator::getSingleton();
    generator.removeAllShaderBasedTechniques(name, "General");
    generator.removeSceneManager(&manager_);
    generator._setActiveSceneManager(nullptr);
    Ogre::MaterialManager::getSingleton().remove(material_);
}

} // namespace engine::ogre_adapter
