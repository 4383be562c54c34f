#pragma once

#include "cpp/json.hpp"

#include <OgreMaterial.h>

namespace engine::ogre_adapter {

/// Creates the material of visible objects. Its fragments are world position and V from OGRE's
/// SGX_ShadowPCF4. Call it once, after OGRE's resources were added.
[[nodiscard]] Ogre::MaterialPtr make_material();

/// Applies the job's [engine] table to the material.
void set_material(Ogre::Material& material, const Json& engine);

} // namespace engine::ogre_adapter
