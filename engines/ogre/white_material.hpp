#pragma once

#include "cpp/json.hpp"
#include "cpp/scene.hpp"

#include <OgreMaterial.h>

namespace Ogre {
class SceneManager;
}

namespace engine::ogre_adapter {

/// OGRE's own white material, with shaders from its RTShader system, which must be initialized.
/// Registers the scene manager with that system while it exists.
class WhiteMaterial {
public:
    /// @param manager      with shadow textures set up, or shadows off.
    /// @param receiver     the adapter's material, whose culling and filtering are copied.
    /// @param is_shadowed  whether to look shadows up.
    WhiteMaterial(Ogre::SceneManager& manager, LightType light, const Ogre::Material& receiver,
                  bool is_shadowed);
    WhiteMaterial(const WhiteMaterial&) = delete;
    WhiteMaterial& operator=(const WhiteMaterial&) = delete;
    ~WhiteMaterial();

    [[nodiscard]] const Ogre::MaterialPtr& material() const { return material_; }
    /// The material scheme by which a viewport selects the shaders.
    [[nodiscard]] static const Ogre::String& scheme();

private:
    Ogre::SceneManager& manager_;
    Ogre::MaterialPtr material_;
};

} // namespace engine::ogre_adapter
