#include "case_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
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
    if (is_sanitized) {
        GTEST_SKIP() << "36 runs take minutes under sanitizers";
    }
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
