#pragma once

#include "cpp/scene.hpp"

#include <QObject>

namespace engine::qt_adapter {

/// Where the camera of scene.qml stands, and what it sees.
/// @param item             What was made of scene.qml.
/// @param units_per_metre  Of Qt Quick 3D's units.
void set_camera(QObject& item, const Scene& scene, double units_per_metre);

/// Turns the scene's light on, and the others stay off.
/// @param engine      The draw's [engine].
/// @param resolution  Texels along a side, as `quality_of` takes them.
/// @param casts       Whether it casts shadows.
void set_light(QObject& item, const Light& light, const Json& engine, int resolution, bool casts);

} // namespace engine::qt_adapter
