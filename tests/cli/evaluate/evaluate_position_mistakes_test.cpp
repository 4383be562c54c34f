#include "mistaken_case.hpp"

#include "lane.hpp"
#include "scene/camera/camera.hpp"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

TEST(EvaluateMistakes, NamesCentimetres)
{
    expect_named(
        [](CaseFolder& folder) {
            folder.move([](float& x, float& y, float& z) { x *= 100, y *= 100, z *= 100; });
            folder.drop_table("camera");
        },
        "centimetres where the mesh is in metres: set conventions.metres_per_unit = 0.01");
}

TEST(EvaluateMistakes, NamesTheUnitOfTheTwoThatFitsBest)
{
    // The ground goes through the origin, so a small enough P lies on the ground.
    const std::map<double, std::string> factors{
        {0.001, "mesh_metres_per_unit = 0.001, or"},
        {0.01, "metres where the mesh is in centimetres: set conventions.mesh_metres_per_unit"},
        {0.0254, "metres where the mesh is in inches"},
        {0.3048, "metres where the mesh is in feet"},
        {1 / 0.3048, "feet where the mesh is in metres: set conventions.metres_per_unit = 0.3048"},
        {1 / 0.0254, "inches where the mesh is in metres"},
        {1000, "metres_per_unit = 0.001"},
    };
    int number = 0;
    for (const auto& [factor, sentence] : factors) {
        if (!tests::runs_full_tests() && number++ % 3 != 0) {
            continue; // the usual lane tries every third
        }
        CaseFolder& folder = case_of("yard");
        folder.keep_level_0();
        folder.drop_table("camera");
        folder.move([factor = static_cast<float>(factor)](float& x, float& y, float& z) {
            x *= factor, y *= factor, z *= factor;
        });
        folder.write();
        EXPECT_THAT(folder.evaluate({"--check"}).out, HasSubstr(sentence)) << factor;
    }
}

TEST(EvaluateMistakes, NamesAPositionThatTooManyPixelsShare)
{
    CaseFolder& folder = case_of("sphere-plane");
    folder.keep_level_0();
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 240; ++x) {
            for (const char* const name : {"P.X", "P.Y", "P.Z"}) {
                folder.channels[name](x, y) = 0; // a point of the ground
            }
            folder.channels["valid"](x, y) = 1;
        }
    }
    folder.write();
    expect_refused(folder.evaluate(), 2, "the very same position (0, 0, 0)");
}

TEST(EvaluateMistakes, NamesZUp)
{
    expect_named(
        [](CaseFolder& folder) {
            folder.move([](float&, float& y, float& z) {
                const float up = y;
                y = -z;
                z = up;
            });
            folder.drop_table("camera");
        },
        "P and the mesh differ in axes, as if z were up instead of y: set conventions.axes = "
        "[\"x\", \"-z\", \"y\"]");
}

TEST(EvaluateMistakes, NamesLeftHandedPositions)
{
    expect_named(
        [](CaseFolder& folder) {
            folder.move([](float&, float&, float& z) { z = -z; });
            folder.drop_table("camera");
        },
        "handedness");
}

TEST(EvaluateMistakes, NamesHalfFloats)
{
    expect_named(
        [](CaseFolder& folder) {
            folder.move([](float& x, float& y, float& z) {
                x = to_half(x);
                y = to_half(y);
                z = to_half(z);
            });
        },
        "half floats");
}

TEST(EvaluateMistakes, NamesPositionsRelativeToTheCamera)
{
    for (const bool knows_eye : {true, false}) {
        expect_named(
            [&](CaseFolder& folder) {
                const std::size_t at = folder.toml.find("eye = [") + 7;
                float eye[3];
                ASSERT_EQ(
                    std::sscanf(folder.toml.c_str() + at, "%f, %f, %f", &eye[0], &eye[1], &eye[2]),
                    3);
                folder.move(
                    [&](float& x, float& y, float& z) { x -= eye[0], y -= eye[1], z -= eye[2]; });
                if (!knows_eye) {
                    folder.drop_table("camera");
                }
            },
            "relative to the camera");
    }
}

TEST(EvaluateMistakes, NamesPositionsInViewSpace)
{
    for (const float depth_sign : {-1.0F, 1.0F}) { // GL's and Direct3D's
        CaseFolder& folder = case_of("yard");
        scene::CameraSettings settings;
        const auto read = [&](const std::string& key, scene::Vec3d& v) {
            const std::size_t at = folder.toml.find(key) + key.size();
            ASSERT_EQ(std::sscanf(folder.toml.c_str() + at, "%lf, %lf, %lf", &v.x, &v.y, &v.z), 3);
        };
        read("eye = [", settings.eye);
        read("target = [", settings.target);
        const scene::Camera camera = scene::make_camera(settings);
        folder.move([&](float& x, float& y, float& z) {
            const scene::Vec3d from_eye = scene::Vec3d{x, y, z} - camera.eye;
            x = static_cast<float>(glm::dot(from_eye, camera.right));
            y = static_cast<float>(glm::dot(from_eye, camera.up));
            z = depth_sign * static_cast<float>(glm::dot(from_eye, camera.forward));
        });
        folder.keep_level_0();
        folder.write();
        EXPECT_EQ(folder.evaluate({"--check"}).exit_code, 1);
        expect_refused(folder.evaluate(), 2, "P is in view space");
    }
}

TEST(EvaluateMistakes, NamesAnImageUpsideDownAgainstItsCamera)
{
    expect_named(
        [](CaseFolder& folder) {
            for (auto& [name, image] : folder.channels) {
                flip_rows(image);
            }
        },
        "the image is flipped against the camera: its rows");
}

TEST(EvaluateMistakes, NamesNumbersOfOtherObjects)
{
    CaseFolder& folder = case_of("yard");
    auto& numbers = folder.channels["id.geom"];
    change_each(numbers, [](float number) { return number + 1; });
    folder.write();
    expect_refused(folder.evaluate(), 2, "every number is 1 larger than [objects] says");
    folder.drop_table("objects");
    folder.write();
    expect_refused(folder.evaluate(), 2, "1 larger than the object's place in the mesh file");
    change_each(numbers, [](float number) {
        return number == 1 ? 2.0F : number == 2 ? 1.0F : number;
    });
    folder.write();
    expect_refused(folder.evaluate(), 2, "they fit with \"");
}

TEST(EvaluateMistakes, LeaveFewPixelsOnNoSurfaceOpen)
{
    CaseFolder& folder = case_of("sphere-plane");
    auto& numbers = folder.channels["id.geom"];
    for (int x = 110; x < 130; ++x) { // the ground before the sphere
        numbers(x, 120) = 1 - numbers(x, 120);
    }
    folder.write();
    const Ending ending = folder.evaluate({"--json"});
    EXPECT_THAT(ending.out, HasSubstr("\"off_surface_pixels\": 20"));
    EXPECT_THAT(ending.out, HasSubstr("\"rounding\": 20"));
    EXPECT_THAT(folder.evaluate().out, HasSubstr("20 pixels not decided: farther than"));
    // Even a large tolerance does not grow boxes to the size of the scene.
    folder.restore();
    folder.keep_level_0();
    folder.drop_table("camera");
    folder.move([](float&, float& y, float&) { y += 1; });
    folder.write();
    EXPECT_THAT(folder.evaluate({"--tolerance-m", "100"}).out, HasSubstr("pixels not decided"));
}

TEST(EvaluateMistakes, NamesNormalsOfAnotherSideOrNone)
{
    const auto change = [](const std::function<void(float&, float&, float&)>& change_normal) {
        CaseFolder& folder = case_of("yard");
        auto& x = folder.channels["Ng.X"];
        for (std::size_t i = 0; i < x.pixel_count(); ++i) {
            change_normal(x[i], folder.channels["Ng.Y"][i], folder.channels["Ng.Z"][i]);
        }
        folder.write();
    };
    const CaseFolder* const folder = &case_of("yard"); // modified by `change`
    change([](float& x, float& y, float& z) { x = -x, y = -y, z = -z; });
    expect_refused(folder->evaluate(), 2, "Ng points away from camera.eye");
    change([](float& x, float& y, float& z) { std::swap(x, y), std::swap(y, z); });
    expect_refused(folder->evaluate(), 2, "Ng is not the geometric normal of the mesh");
    for (const float nothing : {0.0F, NAN}) {
        CaseFolder& blind = case_of("yard");
        for (const char* const name : {"Ng.X", "Ng.Y", "Ng.Z"}) {
            change_each(blind.channels[name], [nothing](float) { return nothing; });
        }
        blind.drop_table("camera");
        blind.write();
        const Ending ending = blind.evaluate({"--json"});
        EXPECT_THAT(ending.out, HasSubstr("\"level\": 0"));
        EXPECT_THAT(ending.out, HasSubstr("\"attached\": null"));
    }
}

} // namespace
} // namespace gnomon::testing
