// The truth of points, a comparison and a sweep, from C++.
//
//     whole_library FOLDER          where the sweep's results go
#include <gnomon/gnomon.hpp>

#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

using namespace gnomon;

int main(int argc, char** argv)
try {
    const std::vector<scene::Vec3d> corners{{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}};
    const std::vector<api::TriangleIndices> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto table = api::make_array_scene(corners, triangles).scene;
    scene::LightSettings sun;
    sun.direction = scene::Vec3d{0, -1, 0};
    const std::vector<scene::Vec3d> points{{0, 0, 0.25}, {2, 0, 0.25}};
    const scene::PointTruth found = api::truth(*table, points, scene::make_light(sun));
    std::printf("under the table: %s, beside it: %s\n",
                scene::is_blocked(found.point_class[0]) ? "shadowed" : "lit",
                scene::is_lit(found.point_class[1]) ? "lit" : "shadowed");

    const api::JobKeys small{{"image.width", "96"}, {"image.height", "54"}};
    const auto compared = api::compare("columns", small);
    std::printf("columns: %llu pixels are shadowed and should be lit\n",
                static_cast<unsigned long long>(compared.lights.front().metrics.false_shadow));

    api::SweepRunOptions options;
    options.folder = argc > 1 ? argv[1] : "out";
    const auto swept =
        api::sweep("columns", {"bias.constant=[0, 0.001]"}, std::move(options), small);
    std::printf("sweep: %llu of %llu configurations\n", static_cast<unsigned long long>(swept.done),
                static_cast<unsigned long long>(swept.configurations));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "whole_library: %s\n", error.what());
    return 1;
}
