#pragma once

#include "cpp/scene.hpp"

#include <QObject>

namespace engine::qt_adapter {

/// Places the camera of scene.qml.
/// @param item             created from scene.qml.
/// @param units_per_metre  scale of Qt Quick 3D's units.
void set_camera(QObject& item, const Scene& scene, double units_per_metre);

/// Turns on and places the scene's light.
/// @param engine      the draw's [engine].
/// @param resolution  side of the map [texels], as `quality_of` takes it.
/// @param casts       whether the light casts shadows.
void set_light(QObject& item, const Light& light, const Json& engine, int resolution, bool casts);

} // namespace engine::qt_adapter
