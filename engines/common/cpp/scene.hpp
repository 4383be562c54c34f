#pragma once

#include "cpp/glb.hpp"
#include "cpp/json.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace engine {

using Vector3 = std::array<double, 3>;

/// Of an array of three numbers.
[[nodiscard]] Vector3 vector_of(const Json& numbers);
Vector3 operator+(const Vector3& a, const Vector3& b);
Vector3 operator-(const Vector3& a, const Vector3& b);
Vector3 operator*(double k, const Vector3& a);
double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
double length(const Vector3& a);
Vector3 normalized(const Vector3& a);

/// An object of the mesh, and what the job says of it.
struct SceneObject {
    GlbObject shape;
    bool casts = true;
    bool is_seen = true;
};

struct Camera {
    Vector3 eye{};
    Vector3 target{};
    Vector3 up{};
    std::optional<double> vertical_fov_deg;    ///< of a perspective camera
    std::optional<double> orthographic_height; ///< of the others [m]
};

enum class LightType { directional, spot, point };

struct Light {
    LightType type = LightType::directional;
    Vector3 position{};  ///< spot, point
    Vector3 direction{}; ///< directional, spot: the way the light travels, of length 1
    double cone_deg = 0; ///< spot: the full opening angle
};

/// What a request `open` tells, with the mesh read.
struct Scene {
    std::vector<SceneObject> objects;
    Camera camera;
    Light light;
    int width = 0;  ///< [px]
    int height = 0; ///< [px]
};

/// @throws std::runtime_error  if the mesh cannot be read.
[[nodiscard]] Scene read_scene(const Json& open);

/// The least box around all objects: its lower and its upper corner.
[[nodiscard]] std::array<Vector3, 2> bounds(const Scene& scene);

/// Distances along the camera's axis that hold all that it can see of the scene [m].
struct Planes {
    double near = 0;
    double far = 0;
};
/// Near is a thousandth of the scene's diagonal; of a camera without perspective it lies behind the
/// eye, at -far.
[[nodiscard]] Planes camera_planes(const Scene& scene);

} // namespace engine
