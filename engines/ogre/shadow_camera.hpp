#pragma once

#include "cpp/json.hpp"

#include <OgreSharedPtr.h>

#include <OgreShadowCameraSetup.h>

namespace engine::ogre_adapter {

/// Places a directional light's map as the request says, instead of fitting it to the camera's
/// view.
[[nodiscard]] Ogre::ShadowCameraSetupPtr place_as_told(const Json& shadow_map);

} // namespace engine::ogre_adapter
