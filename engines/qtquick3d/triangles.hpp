#pragma once

#include "cpp/glb.hpp"

#include <QtQuick3D/QQuick3DGeometry>

namespace engine::qt_adapter {

/// An object's triangles, each with its own normal.
class Triangles : public QQuick3DGeometry {
public:
    explicit Triangles(const GlbObject& shape);
};

} // namespace engine::qt_adapter
