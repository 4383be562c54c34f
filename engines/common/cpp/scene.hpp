#pragma once

#include "cpp/json.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace engine {
using Vector3 = std::array<double, 3>;

/// Reads an array of three numbers.
[[nodiscard]] Vector3 vector_of(const Json& numbers);
Vector3 operator+(const Vector3& a, const Vector3& b);
Vector3 operator-(const Vector3& a, const Vector3& b);
Vector3 operator*(double k, const Vector3& a);
double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
double length(const Vector3& a);
Vector3 normalized(const Vector3& a);

/// An object of the mesh file.
struct GlbObject {
    std::string name;
    std::vector<float> corners; ///< nine coordinates a triangle, world space [m]
};

/// An object with its roles in the job.
struct SceneObject {
    GlbObject shape;
    bool casts = true;
    bool is_seen = true;
};

struct Camera {
    Vector3 eye{};
    Vector3 target{};
    Vector3 up{};
    std::optional<double> vertical_fov_deg;    ///< perspective cameras
    std::optional<double> orthographic_height; ///< orthographic cameras [m]
};

enum class LightType { directional, spot, point };

struct Light {
    LightType type = LightType::directional;
    Vector3 position{};  ///< spot, point
    Vector3 direction{}; ///< directional, spot: the unit direction of the light's travel
    double cone_deg = 0; ///< spot: the full opening angle
};

/// The content of an `open` request, with the mesh.
struct Scene {
    std::vector<SceneObject> objects;
    Camera camera;
    Light light;
    int width = 0;  ///< [px]
    int height = 0; ///< [px]
};

/// @throws std::runtime_error  if the mesh cannot be read.
[[nodiscard]] Scene read_scene(const Json& open);

/// The lower and upper corner of the bounding box of all objects.
[[nodiscard]] std::array<Vector3, 2> bounds(const Scene& scene);

/// Distances along the camera's axis that contain the visible scene [m].
struct Planes {
    double near = 0;
    double far = 0;
};
/// Near is a thousandth of the scene's diagonal; for an orthographic camera it is -far.
[[nodiscard]] Planes camera_planes(const Scene& scene);

} // namespace engine
