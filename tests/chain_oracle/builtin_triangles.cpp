// Prints a built-in scene's triangles in their order, nine hexadecimal floats a line.

#include "scene/builtin/scenes.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>

int main(int argc, char** argv)
{
    if (argc != 2) {
        return EXIT_FAILURE;
    }
    namespace scene = gnomon::scene;
    const scene::BuiltinScene& builtin = scene::find_builtin_scene(argv[1]);
    const scene::TriangleScene triangles = builtin.build(complete_parameters(builtin, {}));
    for (std::uint32_t triangle = 0; triangle < triangles.triangles.size(); ++triangle) {
        const auto [a, b, c] = triangles.corners(triangle);
        fmt::print("{:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a}\n", a.x, a.y, a.z, b.x, b.y, b.z,
                   c.x, c.y, c.z);
    }
}
