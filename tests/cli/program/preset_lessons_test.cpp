// The errors that lessons show and fix, measured with their presets at 320×180 pixels.

#include "child_process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using LessonJson = nlohmann::json;

/// The result of a lesson's preset, with more keys.
LessonJson lesson(const std::string& preset, const std::vector<std::string>& settings = {})
{
    std::vector<std::string> arguments{"compare", "--preset", preset, "--json"};
    for (const std::string& setting :
         std::vector<std::string>{"image.width=320", "image.height=180"}) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    for (const std::string& setting : settings) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    const Ending ending = gnomon(arguments);
    EXPECT_EQ(ending.exit_code, 0) << ending.command << "\n" << ending.err;
    LessonJson json = LessonJson::parse(ending.out);
    EXPECT_EQ(json.at("unmatched_kinds").at("mismatch"), 0) << ending.command;
    return json;
}

double lit_share(const LessonJson& json, const char* label)
{
    return json.at("labels").at(label).get<double>() / json.at("pixels").at("lit").get<double>();
}

/// Receivers on a plane lie behind their texel's centre as often as before it, so without a bias
/// about half of the lit pixels shadow themselves. A tenth allows for silhouettes and for surfaces
/// that face the light squarely.
constexpr double half = 0.5;
constexpr double half_tolerance = 0.05;

// --- the textbook ---

TEST(TextbookLesson, HasA32BitMapReadByALinearFilterAndClamped)
{
    const LessonJson job = lesson("lesson-textbook").at("job");
    EXPECT_EQ(job.at("shadow_map.depth_format"), "d32");
    EXPECT_EQ(job.at("lookup.filter"), "linear");
    EXPECT_EQ(job.at("lookup.outside"), "clamp");
    EXPECT_EQ(job.at("shadow_map.near"), 4);
    EXPECT_EQ(job.at("shadow_map.far"), 50);
    EXPECT_EQ(job.at("light.target"), job.at("camera.target")); // aims where the camera does
}

TEST(TextbookLesson, NeedsAToleranceThatIsTriedOut)
{
    const LessonJson without = lesson("lesson-textbook");
    EXPECT_GT(lit_share(without, "acne"), 0.05);
    const LessonJson with = lesson("lesson-textbook", {"bias.constant=0.0008"});
    EXPECT_LT(lit_share(with, "acne"), 0.001);
    EXPECT_LT(with.at("error_rate"), 0.005);
}

TEST(TextbookLesson, CallsNearestPoorAndThereItIsBy)
{
    const std::string tolerance = "bias.constant=0.0008";
    const LessonJson linear = lesson("lesson-textbook", {tolerance});
    const LessonJson nearest = lesson("lesson-textbook", {tolerance, "lookup.filter=nearest"});
    EXPECT_LT(linear.at("error_rate"), nearest.at("error_rate"));
}

TEST(TextbookLesson, IsTypicallyWrongBesideTheMapByItsClamp)
{
    // A map of a third of the cone: most of what is seen lies beside it.
    const std::vector<std::string> narrow{"bias.constant=0.0008", "shadow_map.fit=fixed",
                                          "shadow_map.fov_deg=20"};
    const LessonJson wide = lesson("lesson-textbook", {"bias.constant=0.0008"});
    const LessonJson clamped = lesson("lesson-textbook", narrow);
    EXPECT_EQ(wide.at("causes").at("coverage"), 0);
    EXPECT_GT(clamped.at("causes").at("coverage"), 100);
}

// --- the lecture ---

TEST(LectureLesson, HasAnEpsilonOfATenthThatSeparates)
{
    const LessonJson json = lesson("lesson-lecture");
    EXPECT_EQ(json.at("job").at("shadow_map.resolution"), 1024);
    EXPECT_EQ(json.at("job").at("bias.constant"), 0.1);
    EXPECT_EQ(json.at("labels").at("acne"), 0);
    EXPECT_EQ(json.at("labels").at("peter_panning"), 0);
    EXPECT_LT(json.at("error_rate"), 0.001);
}

TEST(LectureLesson, CannotCompareForEqualityForItShadowsHalf)
{
    const LessonJson json = lesson("lesson-lecture", {"bias.constant=0"});
    EXPECT_NEAR(lit_share(json, "acne"), half, half_tolerance);
}

// --- the OpenGL notes ---

TEST(NotesLesson, HasAnOrthographicMapOf20FromAHundredthTo100)
{
    const LessonJson json = lesson("lesson-opengl-notes");
    EXPECT_EQ(json.at("frustum").at("projection"), "orthographic");
    EXPECT_EQ(json.at("job").at("shadow_map.half_extent"), 20);
    EXPECT_EQ(json.at("frustum").at("near_m"), 0.01);
    EXPECT_EQ(json.at("frustum").at("far_m"), 100);
    EXPECT_EQ(json.at("job").at("lookup.filter"), "pcf3");
}

TEST(NotesLesson, ShadowsAllBesideTheMapByABorderOfDepth0)
{
    const LessonJson border = lesson("lesson-opengl-notes", {"bias.constant=0.005"});
    EXPECT_GT(border.at("labels").at("overshadow"), 500);
    EXPECT_EQ(border.at("labels").at("overshadow"), border.at("causes").at("coverage"));
    // The intended border, of depth 1.
    const LessonJson lit =
        lesson("lesson-opengl-notes", {"bias.constant=0.005", "lookup.outside=lit"});
    EXPECT_EQ(lit.at("labels").at("overshadow"), 0);
}

TEST(NotesLesson, HasAcneWithoutBiasAndLosesContactShadowsToALargeOne)
{
    const LessonJson none = lesson("lesson-opengl-notes", {"lookup.outside=lit"});
    EXPECT_NEAR(lit_share(none, "acne"), half, half_tolerance);
    EXPECT_EQ(none.at("labels").at("peter_panning"), 0);
    const LessonJson slight =
        lesson("lesson-opengl-notes", {"lookup.outside=lit", "bias.constant=0.005"});
    EXPECT_EQ(slight.at("labels").at("acne"), 0);
    const LessonJson large =
        lesson("lesson-opengl-notes", {"lookup.outside=lit", "bias.constant=0.02"});
    EXPECT_GT(large.at("labels").at("peter_panning"),
              10 * slight.at("labels").at("peter_panning").get<int>());
    // Contact is lost where the blocker is nearer than the bias, 0.02 of 100 m along the light.
    EXPECT_LT(large.at("peter_panning_gap_m").at("max"), 0.02 * 99.99 * 1.05);
}

TEST(NotesLesson, FadesEdgesByTheMeanOfNineComparisons)
{
    const std::vector<std::string> mended{"lookup.outside=lit", "bias.constant=0.005"};
    const LessonJson nine = lesson("lesson-opengl-notes", mended);
    EXPECT_GT(nine.at("partial"), 0);
    const LessonJson one =
        lesson("lesson-opengl-notes",
               {"lookup.outside=lit", "bias.constant=0.005", "lookup.filter=nearest"});
    EXPECT_EQ(one.at("partial"), 0);
}

// --- the game ---

TEST(GameLesson, FitsABoxAroundAllVerticesByTheirSortedDepths)
{
    const LessonJson json = lesson("lesson-game");
    EXPECT_EQ(json.at("frustum").at("projection"), "orthographic");
    EXPECT_LT(json.at("frustum").at("near_m"), json.at("frustum").at("far_m"));
    EXPECT_EQ(json.at("causes").at("coverage"), 0); // the box holds everything
}

TEST(GameLesson, RefusesNearAndFarInTheOrderOfNumbers)
{
    // Depths from -3.5 to -0.0034: -z_min and -z_max are swapped.
    expect_refused(gnomon({"compare", "--preset", "lesson-game", "--set", "shadow_map.near=3.5",
                           "--set", "shadow_map.far=0.0034"}),
                   2, "must be less than shadow_map.far");
}

TEST(GameLesson, HasNoBiasAndShadowsHalfOfItsScene)
{
    EXPECT_NEAR(lit_share(lesson("lesson-game"), "acne"), half, half_tolerance);
    EXPECT_LT(lit_share(lesson("lesson-game", {"bias.constant_m=0.03"}), "acne"), 0.02);
}

// --- the WebGL lesson ---

TEST(WebglLesson, HasAMapOf512FromAHalfTo10)
{
    const LessonJson json = lesson("lesson-webgl");
    EXPECT_EQ(json.at("job").at("shadow_map.resolution"), 512);
    EXPECT_EQ(json.at("frustum").at("near_m"), 0.5);
    EXPECT_EQ(json.at("frustum").at("far_m"), 10);
    EXPECT_EQ(json.at("job").at("lookup.outside"), "lit");
}

TEST(WebglLesson, ShowsAcneOnHalfOfWhatIsLitAndABiasRemovesIt)
{
    EXPECT_NEAR(lit_share(lesson("lesson-webgl"), "acne"), half, half_tolerance);
    EXPECT_LT(lit_share(lesson("lesson-webgl", {"bias.constant=0.006"}), "acne"), 0.005);
}

TEST(WebglLesson, ShadowsAsMuchWithItsTestForNotNearer)
{
    // There map <= receiver is shadow, also for equal depths. A bias of minus one float32 step, at
    // depths from 0.5, gives the same.
    const LessonJson without = lesson("lesson-webgl");
    const LessonJson strict = lesson("lesson-webgl", {"bias.constant=-5.9604644775390625e-8"});
    EXPECT_GE(strict.at("false_shadow"), without.at("false_shadow"));
    EXPECT_LT(strict.at("false_shadow").get<double>(),
              1.01 * without.at("false_shadow").get<double>());
}

TEST(WebglLesson, IsTheSameUnderAParallelLightButForItsProjection)
{
    const LessonJson json = lesson("lesson-webgl", {"scene.sphere-plane.light=orthographic"});
    EXPECT_EQ(json.at("frustum").at("projection"), "orthographic");
    EXPECT_GT(lit_share(json, "acne"), 0.2);
}

TEST(WebglLesson, PacksDepthsIntoFourBytesWhereTheExtensionIsMissing)
{
    const LessonJson json = lesson("lesson-webgl-rgba8", {"bias.constant=0.006"});
    EXPECT_EQ(json.at("job").at("shadow_map.depth_format"), "rgba8");
    EXPECT_EQ(json.at("job").at("shadow_map.resolution"), 512);
    EXPECT_LT(json.at("error_rate"), 0.01);
}

} // namespace
} // namespace gnomon::testing
