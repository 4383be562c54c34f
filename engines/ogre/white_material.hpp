#pragma once

#include "cpp/json.hpp"
#include "cpp/scene.hpp"

#include <OgreMaterial.h>

namespace Ogre {
class SceneManager;
}

namespace engine::ogre_adapter {

/// OGRE's own white material for the lights and shadows of a scene, with shaders that its RTShader
/// system writes. That system must be there, and knows the scene until this ends.
class WhiteMaterial {
public:
    /// @param manager    Its shadow textures must be set, or its shadows be off.
    /// @param receiver   The adapter's material, whose culling and filtering this has, too.
    /// @param is_shadowed  Whether shadows are looked up.
    WhiteMaterial(Ogre::SceneManager& manager, LightType light, const Ogre::Material& receiver,
                  bool is_shadowed);
    WhiteMaterial(const WhiteMaterial&) = delete;
    WhiteMaterial& operator=(const WhiteMaterial&) = delete;
    ~WhiteMaterial();

    [[nodiscard]] const Ogre::MaterialPtr& material() const { return material_; }
    /// The scheme of materials by which a viewport chooses the shaders.
    [[nodiscard]] static const Ogre::String& scheme();

private:
    Ogre::SceneManager& manager_;
    Ogre::MaterialPtr material_;
};

} // namespace engine::ogre_adapter
