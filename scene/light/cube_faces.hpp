#pragma once

#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// A signed world axis: components are −1, 0 and 1.
using WorldAxis = std::array<int, 3>;

/// A face of a cube around a point light, oriented as GL's cube maps are.
///
/// Source: OpenGL 4.6 core, table 8.19, "Selection of cube map images".
struct CubeFace {
    std::string_view name; ///< the axis that it looks along: "+x"
    WorldAxis forward;
    WorldAxis right; ///< the direction of growing u
    WorldAxis up;    ///< the direction of growing v
};

inline constexpr std::size_t cube_face_count = 6;

/// In GL's order, which is that of the light's maps.
inline constexpr std::array<CubeFace, cube_face_count> cube_faces{{
    {"+x", {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {"-x", {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {"+y", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {"-y", {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {"+z", {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {"-z", {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

/// The face that a direction hits: the one of its component with the largest magnitude, the first
/// among equals.
[[nodiscard]] std::size_t cube_face_towards(const Vec3f& direction);

/// The cameras of a point light's six maps: 90° each, along the world's axes. The rows x, y and w
/// of their matrices are exact. All share near and far: from the settings, or around all triangles
/// as for a spot (`fit_light_frustum`).
/// @throws InputError  if near >= far, or near <= 0.
[[nodiscard]] std::vector<LightFrustum>
fit_cube_faces(const FrustumSettings& settings, const Light& light, const TriangleScene& scene);

} // namespace gnomon::scene
