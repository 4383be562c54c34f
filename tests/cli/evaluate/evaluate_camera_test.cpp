// Cases with a mask and the whole camera, but no positions.

#include "case_folder.hpp"
#include "raw_files.hpp"

#include "lane.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using scene::PixelClass;
using ::testing::HasSubstr;
using CameraJson = nlohmann::json;

/// The result of `evaluate`, pixel by pixel.
struct Judged {
    CameraJson json;
    scene::Image<PixelClass> classes;
};

Judged judge(const CaseFolder& folder)
{
    const std::filesystem::path aov = folder.at("judged.exr");
    const Ending ending = folder.evaluate({"--json", "--aov", aov.string()});
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err << folder.toml;
    return {CameraJson::parse(ending.out, nullptr, false),
            store::LayerFile{aov, "a test needs it"}.classes()};
}

bool is_wrong(const Judged& judged, const CaseFolder& folder, std::size_t i)
{
    const bool is_lit = folder.channels.at("shadow.V")[i] >= 0.5F;
    return (judged.classes[i] == PixelClass::lit && !is_lit) ||
           (judged.classes[i] == PixelClass::blocked && is_lit);
}

void drop_positions(CaseFolder& folder)
{
    std::erase_if(folder.channels, [](const auto& one) { return one.first.starts_with("P."); });
}

/// Compares a case without positions with the same case with positions.
void expect_judged_alike(const CaseFolder& folder, const Judged& with, const Judged& without)
{
    EXPECT_EQ(with.json.at("evaluate").at("positions"), "image");
    EXPECT_TRUE(with.json.at("evaluate").at("silhouette_pixels").is_null());
    EXPECT_EQ(without.json.at("evaluate").at("positions"), "camera");
    std::uint64_t set_aside = 0;
    std::uint64_t kept = 0;
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < with.classes.pixel_count(); ++i) {
        if (with.classes[i] == PixelClass::background) {
            EXPECT_EQ(without.classes[i], PixelClass::background) << "pixel " << i;
        } else if (without.classes[i] == PixelClass::background) {
            ++set_aside;
        } else {
            ++kept;
            ASSERT_EQ(without.classes[i], with.classes[i]) << "pixel " << i;
            wrong += is_wrong(with, folder, i) ? 1U : 0U;
        }
    }
    EXPECT_EQ(without.json.at("evaluate").at("silhouette_pixels"), set_aside);
    EXPECT_EQ(without.json.at("false_shadow").get<std::uint64_t>() +
                  without.json.at("false_lit").get<std::uint64_t>(),
              wrong);
    EXPECT_GT(set_aside, 0U);
    EXPECT_GT(kept, 4 * set_aside);
}

TEST(EvaluateCamera, JudgesAsPositionsDoButForSilhouettes)
{
    const std::vector<std::vector<std::string>> cases{{"sphere-plane"},
                                                      {"yard"},
                                                      {"terrain", "--set", "bias.constant=0"},
                                                      {"room", "--set", "camera.eye=[0,2,6]",
                                                       "--set", "camera.target=[0,0.5,0]", "--set",
                                                       "camera.orthographic_height=4"}};
    for (const auto& one : cases) {
        if (!tests::runs_full_tests() && (one.front() == "yard" || one.front() == "terrain")) {
            continue; // the usual lane leaves out the scenes of many triangles
        }
        SCOPED_TRACE(one.front());
        CaseFolder folder{one.front(), {one.begin() + 1, one.end()}};
        const Judged with = judge(folder);
        drop_positions(folder);
        folder.write();
        const Judged without = judge(folder);
        expect_judged_alike(folder, with, without);
        // Its lookup is known, so every remaining pixel has a cause.
        EXPECT_FALSE(without.json.at("causes").is_null());
    }
}

TEST(EvaluateCamera, KnowsTheMirrorImageOfALeftHandedSpace)
{
    CaseFolder folder{"yard"};
    const Judged with = judge(folder);
    drop_positions(folder);
    folder.drop_table("shadow_map");
    folder.drop_table("lookup");
    folder.drop_table("bias");
    std::erase_if(folder.channels, [](const auto& one) {
        return one.first != "shadow.V" && one.first != "valid" && one.first != "id.geom";
    });
    // Flips z in all of the renderer's numbers.
    for (const std::string key : {"eye = ", "target = ", "up = ", "position = "}) {
        for (std::size_t at = folder.toml.find(key); at != std::string::npos;
             at = folder.toml.find(key, at + 1)) {
            const std::size_t last = folder.toml.rfind(' ', folder.toml.find(']', at)) + 1;
            if (folder.toml[last] == '-') {
                folder.toml.erase(last, 1);
            } else {
                folder.toml.insert(last, "-");
            }
        }
    }
    folder.toml += "[conventions]\nhandedness = \"left\"\n[channels]\nfractions = true\n";
    folder.write();
    expect_judged_alike(folder, with, judge(folder));
}

TEST(EvaluateCamera, TakesAMaskWithoutNumbersWhereNothingIsSeen)
{
    CaseFolder folder{"sphere-plane"};
    drop_positions(folder);
    folder.write();
    const Judged valid = judge(folder);
    auto& mask = folder.channels.at("shadow.V");
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (folder.channels.at("valid")[i] == 0) {
            mask[i] = std::numeric_limits<float>::quiet_NaN();
        }
    }
    write_npy(folder.at("mask.npy"), {&mask});
    std::filesystem::remove(folder.at("aov.exr"));
    for (const char* const table : {"shadow_map", "lookup", "bias"}) {
        folder.drop_table(table);
    }
    std::ofstream{folder.at("case.toml")} << folder.toml << "\n[files]\nshadow = \"mask.npy\"\n";
    const Judged nan = judge(folder);
    EXPECT_EQ(nan.json.at("pixels"), valid.json.at("pixels"));
    EXPECT_EQ(nan.json.at("false_shadow"), valid.json.at("false_shadow"));
    EXPECT_EQ(nan.json.at("false_lit"), valid.json.at("false_lit"));
}

TEST(EvaluateCamera, NeedsTheWholeCamera)
{
    CaseFolder folder{"sphere-plane"};
    drop_positions(folder);
    folder.drop_table("camera");
    folder.write();
    expect_refused(folder.evaluate(), 2,
                   "the world position of each pixel is required, or the whole camera");
}

/// A case with a mask in a raw file and the whole camera, and nothing else.
void keep_mask_alone(CaseFolder& folder)
{
    std::filesystem::remove(folder.at("aov.exr"));
    for (const char* const table : {"shadow_map", "lookup", "bias"}) {
        folder.drop_table(table);
    }
    write_npy(folder.at("mask.npy"), {&folder.channels.at("shadow.V")});
}

void write_case(const CaseFolder& folder, const std::string& more = {})
{
    std::ofstream{folder.at("case.toml")} << folder.toml << "\n[files]\nshadow = \"mask.npy\"\n"
                                          << more;
}

TEST(EvaluateCamera, SaysWhyNoPixelIsLeft)
{
    CaseFolder folder{"sphere-plane"};
    keep_mask_alone(folder);
    scene::Image<float> none{folder.channels.at("shadow.V").size(), 0};
    write_npy(folder.at("valid.npy"), {&none});
    write_case(folder, "valid = \"valid.npy\"\n");
    expect_refused(folder.evaluate(), 2, "valid is 0 or the mask NaN everywhere");
    folder.replace("target = [0, 0, 0]", "target = [60, 50, 70]");
    write_case(folder);
    expect_refused(folder.evaluate(), 2, "the camera does not see the mesh there");
    folder.replace("target = [60, 50, 70]", "target = [0, 0, 0]");
    const scene::Image<float> one{{1, 1}, 1};
    write_npy(folder.at("mask.npy"), {&one});
    write_case(folder);
    expect_refused(folder.evaluate(), 2,
                   "a silhouette may cross each of the 1 that show something");
}

TEST(EvaluateCamera, WarnsOfACameraThatTheMaskContradicts)
{
    CaseFolder folder{"yard"};
    keep_mask_alone(folder);
    folder.replace("vertical_fov_deg = 40", "vertical_fov_deg = 60");
    write_case(folder, "[channels]\nfractions = true\n");
    const Ending ending = folder.evaluate({"--check"});
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("of the camera's pixel centres, as the image has none"));
    EXPECT_THAT(ending.out, HasSubstr("so the camera is not the renderer's: look at camera.eye"));
}

TEST(EvaluateCamera, NamesTheOpeningAngleOfAnotherSide)
{
    CaseFolder folder{"yard"};
    keep_mask_alone(folder);
    // tan(h/2) = 240/136 tan(v/2), of the vertical 40 degrees.
    const double tangent = 240.0 / 136.0 * std::tan(std::numbers::pi / 9);
    folder.replace(
        "vertical_fov_deg = 40",
        fmt::format("vertical_fov_deg = {}", 360 / std::numbers::pi * std::atan(tangent)));
    write_case(folder, "[channels]\nfractions = true\n");
    const Ending ending = folder.evaluate({"--check"});
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("is the size from left to right"));
    EXPECT_THAT(ending.out, HasSubstr("the mask fits camera.vertical_fov_deg = 40; set that"));
    expect_refused(folder.evaluate(), 2, "the mask fits camera.vertical_fov_deg = 40");
}

TEST(EvaluateCamera, NamesTheUpThatWasForgotten)
{
    CaseFolder folder{"sphere-plane", {"--set", "camera.up=[0, 0, 1]"}};
    keep_mask_alone(folder);
    const std::string up = "up = [0, 0, 1]\n";
    ASSERT_NE(folder.toml.find(up), std::string::npos) << folder.toml;
    folder.replace(up, "");
    write_case(folder, "[channels]\nfractions = true\n");
    const Ending ending = folder.evaluate({"--check"});
    EXPECT_EQ(ending.exit_code, 1) << ending.err << ending.out;
    EXPECT_THAT(ending.out, HasSubstr("set camera.up = [0, 0, 1]"));
    expect_refused(folder.evaluate(), 2, "set camera.up = [0, 0, 1]");
}

TEST(EvaluateCamera, NamesTheMaskThatIsUpsideDown)
{
    CaseFolder folder{"yard"};
    scene::Image<float>& mask = folder.channels.at("shadow.V");
    const auto [width, height] = mask.size();
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            std::swap(mask(x, y), mask(x, height - 1 - y));
        }
    }
    keep_mask_alone(folder);
    write_case(folder, "[channels]\nfractions = true\n");
    const Ending ending = folder.evaluate({"--check"});
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("its rows are in the opposite order"));
}

TEST(EvaluateCamera, NamesTheAxisThatIsUp)
{
    const std::string z_up =
        "[camera]\neye = [14, -16, 11]\ntarget = [0, 0, 0]\nvertical_fov_deg = 60\n"
        "[light]\ntype = \"directional\"\ndirection = [-0.6, 0.3, -1]\n";
    const std::string y_up =
        "[camera]\neye = [14, 11, 16]\ntarget = [0, 0, 0]\nvertical_fov_deg = 60\n"
        "[light]\ntype = \"directional\"\ndirection = [-0.6, -1, -0.3]\n";
    CaseFolder folder{"columns",
                      {"--set", "camera.eye=[14, 11, 16]", "--set", "camera.target=[0, 0, 0]",
                       "--set", "camera.vertical_fov_deg=60", "--set", "light.type=directional",
                       "--set", "light.direction=[-0.6, -1, -0.3]", "--set",
                       "lookup.filter=nearest", "--set", "bias.constant=0.002", "--set",
                       "shadow_map.resolution=1024"}};
    keep_mask_alone(folder);
    for (const char* const table : {"camera", "light"}) {
        folder.drop_table(table);
    }
    const std::string rest = folder.toml;
    const auto checked = [&](const std::string& tables) {
        folder.toml = rest;
        write_case(folder, tables + "[channels]\nfractions = true\n");
        return folder.evaluate({"--check"});
    };
    EXPECT_EQ(checked(y_up).exit_code, 0);
    EXPECT_EQ(checked(z_up + "[conventions]\nup = \"z\"\n").exit_code, 0);
    const Ending forgotten = checked(z_up);
    EXPECT_EQ(forgotten.exit_code, 1) << forgotten.out;
    EXPECT_THAT(forgotten.out, HasSubstr("set conventions.up = \"z\""));
    const Ending wrong = checked(y_up + "[conventions]\nup = \"z\"\n");
    EXPECT_EQ(wrong.exit_code, 1) << wrong.out;
    EXPECT_THAT(wrong.out, HasSubstr("set conventions.up = \"y\""));
}

TEST(EvaluateCamera, TakesTheMeshsYForUpInARenderersAxes)
{
    CaseFolder folder{"sphere-plane"};
    drop_positions(folder);
    folder.write();
    const Judged own = judge(folder);
    std::erase_if(folder.channels, [](const auto& one) {
        return one.first != "shadow.V" && one.first != "valid" && one.first != "id.geom";
    });
    for (const char* const table : {"shadow_map", "lookup", "bias", "camera", "light"}) {
        folder.drop_table(table);
    }
    // x, −z, y of the mesh: Blender's space.
    folder.toml +=
        "[camera]\neye = [6, -7, 5]\ntarget = [0, 0, 0]\nvertical_fov_deg = 60\n"
        "[light]\ntype = \"spot\"\nposition = [2.5, -4.3, 4.8]\ntarget = [2.5, -3.5, 0]\n"
        "cone_deg = 120\n[conventions]\nup = \"z\"\n";
    folder.write();
    const Judged other = judge(folder);
    EXPECT_EQ(other.json.at("pixels").at("background"), own.json.at("pixels").at("background"))
        << folder.toml;
    EXPECT_EQ(other.json.at("pixels").at("lit"), own.json.at("pixels").at("lit"));
}

TEST(EvaluateCamera, DoesNotReplacePositionsThatArePromised)
{
    CaseFolder folder{"sphere-plane"};
    folder.write();
    std::ofstream{folder.at("case.toml")} << folder.toml << "[channels]\nposition = \"World\"\n";
    expect_refused(folder.evaluate(), 2, "no channel World.X");
}

} // namespace
} // namespace gnomon::testing
