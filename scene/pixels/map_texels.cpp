#include "scene/pixels/map_texels.hpp"

#include "scene/light/cube_faces.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::scene {
namespace {

/// How far a coordinate lies beyond a face's sides; 0 inside.
int beyond(int coordinate, int resolution)
{
    return std::max({-coordinate, coordinate - (resolution - 1), 0});
}

/// A point of a cube whose half side is the resolution, so that texel centres have integer
/// coordinates (odd ones if the resolution is even).
WorldAxis sum(const WorldAxis& a, int of_a, const WorldAxis& b, int of_b, const WorldAxis& c,
              int of_c)
{
    WorldAxis point{};
    for (std::size_t i = 0; i < point.size(); ++i) {
        point[i] = a[i] * of_a + b[i] * of_b + c[i] * of_c;
    }
    return point;
}

int along(const WorldAxis& axis, const WorldAxis& point)
{
    return axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2];
}

std::size_t face_with_forward(const WorldAxis& forward)
{
    return static_cast<std::size_t>(std::distance(
        cube_faces.begin(), std::ranges::find(cube_faces, forward, &CubeFace::forward)));
}

} // namespace

Texel texel_across_seams(const Texel& texel, int resolution_texels)
{
    const int n = resolution_texels;
    const int beyond_x = beyond(texel.x, n);
    const int beyond_y = beyond(texel.y, n);
    if (beyond_x == 0 && beyond_y == 0) {
        return texel;
    }
    const CubeFace& face = cube_faces.at(static_cast<std::size_t>(texel.map));
    const bool is_across_x = beyond_x >= beyond_y;
    const bool is_low = (is_across_x ? texel.x : texel.y) < 0;
    const WorldAxis& across = is_across_x ? face.right : face.up;
    const WorldAxis& beside = is_across_x ? face.up : face.right;
    const int row = std::clamp(is_across_x ? texel.y : texel.x, 0, n - 1);
    const int sign = is_low ? -1 : 1;
    const int from_seam = std::min(is_across_x ? beyond_x : beyond_y, n); // counted from 1
    const std::size_t next = face_with_forward(sum(across, sign, across, 0, across, 0));
    const WorldAxis centre =
        sum(across, sign * n, face.forward, n - (2 * from_seam - 1), beside, 2 * row + 1 - n);
    const auto coordinate = [&](const WorldAxis& axis) {
        return (along(axis, centre) + n - 1) / 2;
    };
    return {coordinate(cube_faces.at(next).right), coordinate(cube_faces.at(next).up),
            static_cast<int>(next)};
}

} // namespace gnomon::scene
