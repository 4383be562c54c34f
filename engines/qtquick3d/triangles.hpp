#pragma once

#include "cpp/scene.hpp"

#include <QtQuick3D/QQuick3DGeometry>

namespace engine::qt_adapter {

/// An object's triangles with flat normals.
class Triangles : public QQuick3DGeometry {
public:
    explicit Triangles(const GlbObject& shape);
};

} // namespace engine::qt_adapter
