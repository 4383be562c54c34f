#pragma once

#include "cpp/json.hpp"

#include <OgreMaterial.h>

namespace engine::ogre_adapter {

/// The material of all that is seen: its fragments are the world's position and V, which OGRE's own
/// SGX_ShadowPCF4 looks up. Made once; OGRE's resources must be known.
[[nodiscard]] Ogre::MaterialPtr make_material();

/// Gives the material what the job's [engine] table says.
void set_material(Ogre::Material& material, const Json& engine);

} // namespace engine::ogre_adapter
