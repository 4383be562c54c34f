#include "compared.hpp"
#include "expectations.hpp"
#include "lane.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

/// Point lights in all kinds of places, also degenerate ones: an independent checker certifies the
/// truth, and every error of GL's six maps has a cause.
namespace gnomon::tests {
namespace {

using scene::ClassReason;
using scene::PixelClass;
using scene::TriangleScene;
using scene::Vec3d;

using Keys = std::vector<scene::Override>;

/// A built-in scene with the position of its light.
struct LitScene {
    std::string name; ///< of the test
    std::string builtin;
    std::function<Vec3d(const TriangleScene&, const scene::Job&)> light;
    Keys keys = {};

    friend void PrintTo(const LitScene& shown, std::ostream* out) { *out << shown.name; }
};

auto at(const Vec3d& point)
{
    return [point](const TriangleScene&, const scene::Job&) { return point; };
}

Vec3d at_eye(const TriangleScene&, const scene::Job& job)
{
    return job.camera->eye;
}

/// The centre of an object's bounding box.
auto inside(const std::string& object)
{
    return [object](const TriangleScene& scene, const scene::Job&) {
        const auto& found = *std::ranges::find(scene.objects, object, &scene::Object::name);
        scene::Box box{Vec3d{scene.corners(found.first_triangle)[0]},
                       Vec3d{scene.corners(found.first_triangle)[0]}};
        for (std::uint32_t i = 0; i < found.triangle_count; ++i) {
            for (const scene::Vec3f& corner : scene.corners(found.first_triangle + i)) {
                box.lower = glm::min(box.lower, Vec3d{corner});
                box.upper = glm::max(box.upper, Vec3d{corner});
            }
        }
        return box.centre();
    };
}

/// The centroid of a triangle, by its share of the list of triangles.
auto on_triangle(double share)
{
    return [share](const TriangleScene& scene, const scene::Job&) {
        const auto [a, b, c] = scene.corners(
            static_cast<std::uint32_t>(share * static_cast<double>(scene.triangles.size())));
        return (Vec3d{a} + Vec3d{b} + Vec3d{c}) / 3.0;
    };
}

auto on_vertex(double share)
{
    return [share](const TriangleScene& scene, const scene::Job&) {
        return Vec3d{scene.vertices[static_cast<std::size_t>(
            share * static_cast<double>(scene.vertices.size()))]};
    };
}

/// This number of scene diagonals from the centre, along (2, 2, 1)/3.
auto away(double diagonals)
{
    return [diagonals](const TriangleScene& scene, const scene::Job&) {
        const scene::Box box = scene.bounds();
        return box.centre() + diagonals * box.diagonal_m() / 3 * Vec3d{2, 2, 1};
    };
}

/// Under the centre, half a diagonal below the lowest point.
Vec3d from_below(const TriangleScene& scene, const scene::Job&)
{
    const scene::Box box = scene.bounds();
    return {box.centre().x, box.lower.y - box.diagonal_m() / 2, box.centre().z};
}

std::vector<LitScene> lit_scenes()
{
    const Keys coarse{{"scene.terrain.cells", "64"}}; // because the checker tries all triangles
    return {
        {"InAPedestal", "columns", inside("pedestal_left")},
        {"InASphere", "sphere-plane", inside("sphere")},
        {"InTheWallsOfARoom", "room", inside("inner")},
        {"BetweenTheWallsOfARoom", "room", at({3.1, 1.5, 0.25})},
        {"InAClosedRoom", "lamp-room", at({0.3, 1.9, 0.2})},
        {"InThePlaneOfTheGroundAndBesideIt", "fence", at({-9, 0, 1.5})},
        {"OnTheGround", "yard", at({2.5, 0, 3.25})},
        {"OnASheet", "wall", at({0, 1, 0.5})},
        {"OnATriangleOfHills", "terrain", on_triangle(0.5), coarse},
        {"OnATriangleOfAColumn", "columns", on_triangle(0.5)},
        {"OnAVertexOfHills", "terrain", on_vertex(0.5), coarse},
        {"OnAVertexOfASphere", "sphere-cube", on_vertex(0.7)},
        {"OnTheYAxis", "sphere-plane", at({0, 6, 0})},
        {"OnTheZAxis", "wall", at({0, 0, 2.5})},
        {"AtTheOrigin", "columns", at({0, 0, 0})},
        {"AtTheOriginInACube", "sphere-cube", at({0, 0, 0})},
        {"AtTheEye", "yard", at_eye},
        {"AtTheEyeInARoom", "lamp-room", at_eye},
        {"AThousandDiagonalsAway", "fence", away(1e3)},
        {"AMillionDiagonalsAway", "sphere-plane", away(1e6)},
        {"BelowAYard", "yard", from_below},
        {"BelowAColonnade", "columns", from_below},
    };
}

scene::Job lit_job(const LitScene& lit, const TriangleScene& scene, std::string_view filter)
{
    const Vec3d at = lit.light(scene, scene::builtin_job(lit.builtin).job);
    Keys keys{{"light.type", "point"},
              // 17 digits keep the bits of a vertex.
              {"light.position", fmt::format("[{:.17g}, {:.17g}, {:.17g}]", at.x, at.y, at.z)},
              {"image.width", "320"},
              {"image.height", "180"},
              {"shadow_map.resolution", "256"},
              {"shadow_map.near", "auto"},
              {"shadow_map.far", "auto"},
              {"bias.constant", "0.003"},
              {"lookup.filter", std::string{filter}}};
    keys.insert(keys.end(), lit.keys.begin(), lit.keys.end());
    return scene::builtin_job(lit.builtin, keys).job;
}

void print_counts(const LitScene& lit, std::string_view filter, const analysis::Metrics& metrics)
{
    const analysis::ClassCounts& pixels = metrics.pixels;
    std::cout << fmt::format("{} ({}, {}): {} lit, {} blocked, {} attached, {} indeterminate; "
                             "{} false shadow, {} false lit\n",
                             lit.name, lit.builtin, filter, pixels.of(PixelClass::lit),
                             pixels.of(PixelClass::blocked), pixels.of(PixelClass::attached),
                             pixels.of(PixelClass::indeterminate), metrics.false_shadow,
                             metrics.false_lit);
}

/// The number of surface pixels to certify, besides those of rare classes.
std::optional<std::uint64_t> certified_sample()
{
    return in_lane<std::optional<std::uint64_t>>(200, std::nullopt);
}

class PointLight : public testing::TestWithParam<LitScene> {};

TEST_P(PointLight, HasACertifiedTruthAndExplainedErrors)
{
    GNOMON_REQUIRE_GL();
    const LitScene& lit = GetParam();
    const Compared compared{scene::builtin_job(lit.builtin, lit.keys).job};
    const TriangleScene& triangles = compared.file().scene;
    for (const char* filter : {"nearest", "pcf3"}) {
        const auto result = compared(lit_job(lit, triangles, filter));
        EXPECT_EQ(result.metrics.pixels.of(ClassReason::mismatch), 0U);
        expect_all_explained(result, filter);
        print_counts(lit, filter, result.metrics);
        if (std::string_view{filter} == "nearest") { // no filter changes the truth
            expect_certified(result, certified_sample());
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, PointLight, testing::ValuesIn(lit_scenes()),
                         [](const auto& lit) { return lit.param.name; });

} // namespace
} // namespace gnomon::tests
