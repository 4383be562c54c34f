#pragma once

#include "cpp/json.hpp"

#include <OgreSharedPtr.h>

#include <OgreShadowCameraSetup.h>

namespace engine::ogre_adapter {

/// Places a directional light's map as the request says, in place of OGRE's fit to what its camera
/// sees.
[[nodiscard]] Ogre::ShadowCameraSetupPtr place_as_told(const Json& shadow_map);

} // namespace engine::ogre_adapter
