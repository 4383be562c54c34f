#include "case_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

/// Scenes with flat ground, with round things, with things in mirrored places, and without a plane.
const std::vector<std::string> mistaken_scenes{"sphere-plane", "yard", "terrain"};

/// A scene's case, as it was written; made once.
CaseFolder& case_of(const std::string& scene)
{
    static std::map<std::string, std::unique_ptr<CaseFolder>> cases;
    auto& folder = cases[scene];
    if (folder == nullptr) {
        folder = std::make_unique<CaseFolder>(
            scene, std::vector<std::string>{"--set", "lookup.filter=nearest"});
    }
    folder->restore();
    return *folder;
}

/// Makes the mistake in each scene: --check says so with exit status 1, evaluating refuses with 2.
void expect_named(const std::function<void(CaseFolder&)>& make_mistake, const std::string& sentence)
{
    for (const std::string& scene : mistaken_scenes) {
        CaseFolder& folder = case_of(scene);
        folder.keep_level_0();
        make_mistake(folder);
        folder.write();
        const Ending checked = folder.evaluate({"--check"});
        EXPECT_EQ(checked.exit_code, 1) << scene << "\n" << checked.out << checked.err;
        EXPECT_THAT(checked.out, HasSubstr(sentence)) << scene;
        if (scene == mistaken_scenes.front()) {
            expect_refused(folder.evaluate(), 2, sentence);
        }
    }
}

void change_each(scene::Image<float>& image, const std::function<float(float)>& change)
{
    std::transform(image.begin(), image.end(), image.data(), change);
}

void flip_rows(scene::Image<float>& image)
{
    const auto [width, height] = image.size();
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            std::swap(image(x, y), image(x, height - 1 - y));
        }
    }
}

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
    // The ground goes through the origin: whatever makes P small enough draws it onto the ground.
    const std::map<double, std::string> factors{
        {0.001, "mesh_metres_per_unit = 0.001, or"},
        {0.01, "metres where the mesh is in centimetres: set conventions.mesh_metres_per_unit"},
        {0.0254, "metres where the mesh is in inches"},
        {0.3048, "metres where the mesh is in feet"},
        {1 / 0.3048, "feet where the mesh is in metres: set conventions.metres_per_unit = 0.3048"},
        {1 / 0.0254, "inches where the mesh is in metres"},
        {1000, "metres_per_unit = 0.001"},
    };
    for (const auto& [factor, sentence] : factors) {
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
        "P has other axes than the mesh, as where z is up instead of y: set conventions.axes = "
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

TEST(EvaluateMistakes, NamesAMaskUpsideDown)
{
    expect_named([](CaseFolder& folder) { flip_rows(folder.channels["shadow.V"]); },
                 "the mask is flipped against P: its rows");
}

TEST(EvaluateMistakes, NamesAMaskThatIsTurnedRound)
{
    for (const bool inverts : {false, true}) {
        CaseFolder& folder = case_of("yard");
        folder.keep_level_0();
        auto& mask = folder.channels["shadow.V"];
        change_each(mask, [inverts](float verdict) { return inverts ? 1 - verdict : verdict; });
        std::reverse(mask.data(), mask.data() + mask.pixel_count());
        folder.write();
        const std::string out = folder.evaluate({"--check"}).out;
        EXPECT_THAT(out, HasSubstr("flipped against P: its rows and columns"));
        EXPECT_EQ(out.find("and it is inverted") != std::string::npos, inverts) << out;
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

TEST(EvaluateMistakes, NamesAnInvertedMask)
{
    expect_named(
        [](CaseFolder& folder) {
            auto& mask = folder.channels["shadow.V"];
            for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
                mask[i] = 1 - mask[i];
            }
        },
        "the mask is inverted");
}

TEST(EvaluateMistakes, NamesALightThatShinesTheOtherWay)
{
    const std::map<std::string, std::string> reversed{
        {"yard", "[-20.1346, 37.1572, 26.7196]"}, {"terrain", "[-0.906923, 0.207912, 0.366421]"}};
    for (const auto& [scene, direction] : reversed) {
        for (const bool knows_eye : {true, false}) {
            CaseFolder& folder = case_of(scene);
            folder.keep_level_0();
            folder.drop_table("light");
            folder.toml += fmt::format("\n[light]\ndirection = {}\n", direction);
            if (!knows_eye) {
                folder.drop_table("camera");
            }
            folder.write();
            expect_refused(folder.evaluate(), 2, "the light seems to shine the other way");
        }
    }
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
    // However much is tolerated, boxes do not grow to the size of the scene.
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
    const CaseFolder* const folder = &case_of("yard"); // the one that `change` changes
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

/// Makes the mask the light on a white surface without shadows: what faces the light, and how much.
void switch_shadows_off(CaseFolder& folder, float x, float y, float z, bool is_directional)
{
    auto& channels = folder.channels;
    auto& mask = channels["shadow.V"];
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        const float at = is_directional ? 0.0F : 1.0F;
        const float light = channels["Ng.X"][i] * (x - at * channels["P.X"][i]) +
                            channels["Ng.Y"][i] * (y - at * channels["P.Y"][i]) +
                            channels["Ng.Z"][i] * (z - at * channels["P.Z"][i]);
        mask[i] = std::max(0.0F, light);
    }
    folder.toml += "\n[channels]\nlit_above = 0\n";
}

TEST(EvaluateMistakes, TakeAPictureWithoutShadowsForNoMistake)
{
    const std::map<std::string, std::pair<std::vector<float>, bool>> lights{
        {"sphere-plane", {{}, false}}, {"yard", {{-20.1346F, 37.1572F, 26.7196F}, true}}};
    for (const auto& [scene, light] : lights) {
        for (const bool knows_side : {true, false}) {
            CaseFolder& folder = case_of(scene);
            float place[3] = {};
            if (light.second) {
                std::copy(light.first.begin(), light.first.end(), place);
            } else {
                const std::size_t at = folder.toml.find("position = [") + 12;
                ASSERT_EQ(std::sscanf(folder.toml.c_str() + at, "%f, %f, %f", &place[0], &place[1],
                                      &place[2]),
                          3);
            }
            for (const char* const table : {"shadow_map", "lookup", "bias"}) {
                folder.drop_table(table);
            }
            switch_shadows_off(folder, place[0], place[1], place[2], light.second);
            if (!knows_side) {
                folder.keep_level_0();
                folder.drop_table("camera");
            }
            folder.write();
            const Ending checked = folder.evaluate({"--check"});
            EXPECT_EQ(checked.exit_code, 0) << scene << checked.out << checked.err;
            EXPECT_THAT(checked.out, HasSubstr("Warning: the mask shows no cast shadow")) << scene;
        }
    }
}

TEST(EvaluateMistakes, ProposeNoLightForAMaskOfOneKind)
{
    for (const std::string& scene : mistaken_scenes) {
        for (const float verdict : {0.0F, 1.0F}) {
            CaseFolder& folder = case_of(scene);
            folder.keep_level_0();
            folder.drop_table("camera");
            change_each(folder.channels["shadow.V"], [verdict](float) { return verdict; });
            folder.write();
            EXPECT_EQ(folder.evaluate({"--check"}).exit_code, 0) << scene << verdict;
        }
    }
}

TEST(EvaluateMistakes, NameALightWithOtherAxes)
{
    CaseFolder& folder = case_of("yard");
    folder.keep_level_0();
    folder.drop_table("light");
    folder.toml += "\n[light]\ndirection = [20.1346, -26.7196, 37.1572]\n";
    folder.write();
    expect_refused(folder.evaluate(), 2, "the mask fits a light with the axes");
}

TEST(EvaluateMistakes, WarnOfAMaskThatSaysNothing)
{
    CaseFolder& folder = case_of("yard");
    change_each(folder.channels["shadow.V"], [](float) { return 1.0F; });
    folder.write();
    const Ending checked = folder.evaluate({"--check"});
    EXPECT_EQ(checked.exit_code, 0);
    EXPECT_THAT(checked.out, HasSubstr("Warning: mask and truth agree no better than by chance"));
    EXPECT_THAT(folder.evaluate().out, HasSubstr("Warning: mask and truth"));
    EXPECT_THAT(folder.evaluate({"--json"}).out, HasSubstr("\"warning\": \"mask and truth"));
}

TEST(EvaluateMistakes, WarnWhereNothingIsScored)
{
    CaseFolder& folder = case_of("sphere-plane");
    folder.keep_level_0();
    folder.drop_table("camera");
    folder.toml += "\n[camera]\neye = [0, -5, 0]\n"; // below the ground, turned from the light
    auto& valid = folder.channels["valid"];
    for (std::size_t i = 0; i < valid.pixel_count(); ++i) {
        valid[i] = folder.channels["P.Y"][i] == 0 ? valid[i] : 0.0F;
    }
    folder.write();
    EXPECT_THAT(folder.evaluate({"--check"}).out, HasSubstr("Warning: no pixel is scored"));
}

TEST(EvaluateMistakes, NamesAnAntiAliasedMask)
{
    expect_named(
        [](CaseFolder& folder) {
            auto& mask = folder.channels["shadow.V"];
            const auto [width, height] = mask.size();
            for (int y = 0; y + 1 < height; ++y) {
                for (int x = 0; x + 1 < width; ++x) {
                    mask(x, y) =
                        (mask(x, y) + mask(x + 1, y) + mask(x, y + 1) + mask(x + 1, y + 1)) / 4;
                }
            }
        },
        "the mask is anti-aliased");
}

TEST(EvaluateMistakes, AreNotSeenInShadowsThatAreMerelyBad)
{
    const std::vector<std::vector<std::string>> settings{
        {},
        {"--set", "bias.constant=0"},          // acne everywhere
        {"--set", "bias.constant=0.9"},        // nothing is shadowed
        {"--set", "bias.constant=-0.01"},      // nearly everything is
        {"--set", "shadow_map.resolution=16"}, // shadows of other shapes
        {"--set", "lookup.filter=pcf9", "--set", "shadow_map.resolution=64"},
    };
    for (const std::string scene : {"sphere-plane", "wall", "room"}) {
        for (const auto& more : settings) {
            const CaseFolder folder{scene, more};
            const Ending ending = folder.evaluate({"--check"});
            EXPECT_EQ(ending.exit_code, 0) << folder.compared.command << "\n"
                                           << ending.out << ending.err;
        }
    }
}

} // namespace
} // namespace gnomon::testing
