#include "scene_item.hpp"

#include "qt_vector.hpp"
#include "settings.hpp"

#include <QQmlProperty>
#include <QQuaternion>

#include <cmath>
#include <stdexcept>

namespace engine::qt_adapter {
namespace {

constexpr double inner_share = 0.99; // of the cone; equal cones would divide by 0

/// The rotation that turns -z to `forward` and y to `up`.
QQuaternion looking(const Vector3& forward, const Vector3& up)
{
    const Vector3 right = normalized(cross(forward, up));
    return QQuaternion::fromAxes(qt_vector(right), qt_vector(cross(right, forward)),
                                 qt_vector(-1 * forward));
}

QObject& child(QObject& item, const char* name)
{
    auto* const found = item.findChild<QObject*>(name);
    if (found == nullptr) {
        throw std::logic_error{std::string{"scene.qml has no "}.append(name)};
    }
    return *found;
}

void set(QObject& object, const char* name, const QVariant& value)
{
    if (!QQmlProperty::write(&object, name, value)) {
        throw std::logic_error{std::string{"Qt Quick 3D does not take "}.append(name)};
    }
}

const char* name_of(LightType type)
{
    switch (type) {
    case LightType::directional:
        return "directional";
    case LightType::spot:
        return "spot";
    case LightType::point:
        return "point";
    }
    throw std::logic_error{"name_of: no such light"};
}

} // namespace

void set_camera(QObject& item, const Scene& scene, double units_per_metre)
{
    const Camera& seen = scene.camera;
    const Planes planes = camera_planes(scene);
    const Vector3 forward = normalized(seen.target - seen.eye);
    Vector3 eye = seen.eye;
    Planes clip = planes;
    QObject& camera = child(item, seen.orthographic_height ? "orthographic" : "perspective");
    if (seen.orthographic_height) {
        // Move the camera back, so that it also sees objects behind the eye.
        eye = eye - planes.far * forward;
        clip = {planes.far * 1e-3, 2 * planes.far};
        const double magnification = scene.height / (*seen.orthographic_height * units_per_metre);
        set(camera, "horizontalMagnification", magnification);
        set(camera, "verticalMagnification", magnification);
    } else {
        set(camera, "fieldOfView", *seen.vertical_fov_deg);
    }
    set(camera, "clipNear", clip.near * units_per_metre);
    set(camera, "clipFar", clip.far * units_per_metre);
    set(camera, "position", qt_vector(units_per_metre * eye));
    set(camera, "rotation", looking(forward, seen.up));
    set(item, "camera", QVariant::fromValue(&camera));
}

void set_light(QObject& item, const Light& light, const Json& engine, int resolution, bool casts)
{
    QObject& made = child(item, name_of(light.type));
    set(made, "visible", true);
    set(made, "castsShadow", casts);
    set(made, "shadowMapQuality", quality_of(resolution));
    for (const char* const key : {"shadowBias", "shadowFactor", "shadowFilter", "shadowMapFar"}) {
        set(made, key, engine.at(key).get<double>());
    }
    if (light.type != LightType::directional) {
        set(made, "position", qt_vector(units_per_metre(engine) * light.position));
    }
    if (light.type != LightType::point) {
        const bool is_vertical = std::abs(light.direction[1]) > 0.9;
        set(made, "rotation",
            looking(light.direction, is_vertical ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
    }
    if (light.type == LightType::spot) {
        set(made, "coneAngle", light.cone_deg);
        set(made, "innerConeAngle", light.cone_deg * inner_share);
    }
}

} // namespace engine::qt_adapter
