#pragma once

#include "cpp/scene.hpp"

#include <QVector3D>

namespace engine::qt_adapter {

inline QVector3D qt_vector(const Vector3& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

} // namespace engine::qt_adapter
