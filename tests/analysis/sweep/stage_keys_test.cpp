// The keys on which a job's stages depend.

#include "analysis/sweep/stage_keys.hpp"

#include "methods/key_table.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

scene::Job job_with(const std::vector<scene::Override>& overrides)
{
    return scene::make_job(scene::builtin_job_source("wall", overrides, {}, methods::key_table()));
}

/// Names of the stages whose keys the override changes.
std::vector<std::string> changed_by(const scene::Override& change,
                                    std::vector<scene::Override> base = {})
{
    const StageKeys before = stage_keys(job_with(base));
    base.push_back(change);
    const StageKeys after = stage_keys(job_with(base));
    const std::vector<std::pair<std::string, std::string StageKeys::*>> members{
        {"scene", &StageKeys::scene},         {"light", &StageKeys::light},
        {"truth", &StageKeys::truth},         {"frustum", &StageKeys::frustum},
        {"receivers", &StageKeys::receivers}, {"map", &StageKeys::map},
        {"filtered", &StageKeys::filtered},   {"lookup", &StageKeys::lookup},
        {"curve", &StageKeys::curve}};
    std::vector<std::string> changed;
    for (const auto& [name, member] : members) {
        if (before.*member != after.*member) {
            changed.push_back(name);
        }
    }
    return changed;
}

TEST(StageKeys, ChangeWithTheStagesThatAKeyDecides)
{
    EXPECT_THAT(
        changed_by({"scene.builtin", "room"}),
        ElementsAre("scene", "light", "truth", "frustum", "receivers", "map", "lookup", "curve"));
    EXPECT_THAT(
        changed_by({"scene.no_cast", "[\"cube\"]"}),
        ElementsAre("scene", "light", "truth", "frustum", "receivers", "map", "lookup", "curve"));
    EXPECT_THAT(changed_by({"light.direction", "[0, -1, 0.25]"}),
                ElementsAre("light", "truth", "frustum", "receivers", "map", "lookup", "curve"));
    for (const scene::Override& camera : {scene::Override{"camera.eye", "[1, 2, 9]"},
                                          {"camera.vertical_fov_deg", "33"},
                                          {"image.width", "77"}}) {
        EXPECT_THAT(changed_by(camera), ElementsAre("truth", "receivers", "lookup", "curve"))
            << camera.key;
    }
    for (const scene::Override& matrix : {scene::Override{"shadow_map.near", "0.125"},
                                          {"shadow_map.far", "99"},
                                          {"shadow_map.roll_deg", "3"},
                                          {"shadow_map.reversed", "true"}}) {
        EXPECT_THAT(changed_by(matrix),
                    ElementsAre("frustum", "receivers", "map", "lookup", "curve"))
            << matrix.key;
    }
    for (const scene::Override& map : {scene::Override{"shadow_map.resolution", "77"},
                                       {"shadow_map.depth_format", "d16"},
                                       {"shadow_map.cull", "front"}}) {
        EXPECT_THAT(changed_by(map), ElementsAre("map", "lookup", "curve")) << map.key;
    }
    for (const scene::Override& lookup : {scene::Override{"lookup.filter", "pcf3"},
                                          {"lookup.outside", "clamp"},
                                          {"bias.normal_texels", "1.5"}}) {
        EXPECT_THAT(changed_by(lookup), ElementsAre("lookup", "curve")) << lookup.key;
    }
    EXPECT_THAT(changed_by({"bias.slope", "1.5"}), ElementsAre("curve"));
    EXPECT_THAT(changed_by({"bias.constant", "0.5"}), IsEmpty());
    EXPECT_THAT(changed_by({"bias.constant_m", "0.5"}), IsEmpty());
}

TEST(StageKeys, FollowTheCameraWhereTheMapDoes)
{
    const std::vector<scene::Override> fit{{"shadow_map.fit", "camera"}};
    EXPECT_THAT(changed_by({"camera.eye", "[1, 2, 9]"}, fit),
                ElementsAre("truth", "frustum", "receivers", "map", "lookup", "curve"));
    EXPECT_THAT(changed_by({"image.height", "77"}, fit),
                ElementsAre("truth", "frustum", "receivers", "map", "lookup", "curve"));
    EXPECT_THAT(changed_by({"bias.constant", "0.5"}, fit), IsEmpty());
}

TEST(StageKeys, DrawReceiversOnceForAllLightMatricesWhereThePixelPlacesThem)
{
    const std::vector<scene::Override> of_pixel{{"lookup.position", "pixel"}};
    EXPECT_THAT(changed_by({"shadow_map.roll_deg", "5"}),
                ElementsAre("frustum", "receivers", "map", "lookup", "curve"));
    EXPECT_THAT(changed_by({"shadow_map.roll_deg", "5"}, of_pixel),
                ElementsAre("frustum", "map", "lookup", "curve"));
    EXPECT_THAT(changed_by({"camera.eye", "[1, 2, 9]"}, of_pixel),
                ElementsAre("truth", "receivers", "lookup", "curve"));
    const StageKeys one = stage_keys(job_with({{"lookup.position", "pixel"}}));
    const StageKeys rolled =
        stage_keys(job_with({{"lookup.position", "pixel"}, {"shadow_map.roll_deg", "5"}}));
    EXPECT_NE(one.exact, rolled.exact) << "what exact rays say follows the matrix";
}

TEST(StageKeys, LookEveryBiasUpToKeepPixelsAlone)
{
    const std::vector<scene::Override> hardware{{"lookup.filter", "hardware"}};
    EXPECT_THAT(changed_by({"bias.constant", "0.5"}, hardware), IsEmpty());
    EXPECT_THAT(changed_by({"bias.slope", "1.5"}, hardware), ElementsAre("curve"));
    const StageKeys zero = stage_keys_with_bias(job_with({}));
    const StageKeys half = stage_keys_with_bias(job_with({{"bias.constant", "0.5"}}));
    EXPECT_EQ(zero.map, half.map);
    EXPECT_EQ(zero.receivers, half.receivers);
    EXPECT_NE(zero.lookup, half.lookup);
    EXPECT_NE(zero.curve, half.curve);
}

TEST(StageKeys, NameEveryKeyExactlyOnce)
{
    for (const char* const method : {"depth", "vsm"}) {
        const scene::Job job = job_with({{"method.name", method}});
        const std::string curve = stage_keys_with_bias(job).curve;
        for (const auto& [key, value] : scene::resolved_keys(job)) {
            const std::string line = fmt::format("{}={}\n", key, value);
            EXPECT_NE(curve.find(line), std::string::npos) << line;
        }
    }
}

TEST(StageKeys, SayWhatAMethodMakesOfTheMap)
{
    const std::vector<scene::Override> vsm{{"method.name", "vsm"}};
    EXPECT_THAT(changed_by(vsm[0]), ElementsAre("filtered", "lookup", "curve"));
    for (const scene::Override& pass : {scene::Override{"method.content", "rg16"},
                                        {"method.kernel", "gaussian"},
                                        {"method.kernel_width", "3"}}) {
        EXPECT_THAT(changed_by(pass, vsm), ElementsAre("filtered", "lookup", "curve")) << pass.key;
    }
    for (const scene::Override& lookup : {scene::Override{"method.bleeding_reduction", "0.25"},
                                          {"method.min_variance", "0.5"},
                                          {"lookup.outside", "clamp"},
                                          {"bias.normal_texels", "1.5"}}) {
        EXPECT_THAT(changed_by(lookup, vsm), ElementsAre("lookup", "curve")) << lookup.key;
    }
    EXPECT_THAT(changed_by({"shadow_map.depth_format", "d16"}, vsm),
                ElementsAre("map", "filtered", "lookup", "curve"));
    EXPECT_THAT(changed_by({"bias.slope", "1.5"}, vsm), ElementsAre("curve"));
    EXPECT_THAT(changed_by({"bias.constant", "0.5"}, vsm), IsEmpty());
}

TEST(StageKeys, AreFilteredOnlyWhereAMethodHasPasses)
{
    for (const char* const filter : {"nearest", "linear", "hardware", "pcf9"}) {
        EXPECT_EQ(stage_keys(job_with({{"lookup.filter", filter}})).filtered, "") << filter;
    }
    const StageKeys vsm = stage_keys(job_with({{"method.name", "vsm"}}));
    EXPECT_THAT(vsm.filtered, AllOf(StartsWith(vsm.map), HasSubstr("method.kernel=\"box\"\n")));
}

TEST(StageKeys, OfAllMethodsAndFiltersShareWhatExactRaysSay)
{
    const std::string depth = stage_keys(job_with({})).exact;
    const std::vector<scene::Override> vsm{{"method.name", "vsm"}};
    EXPECT_EQ(stage_keys(job_with(vsm)).exact, depth);
    EXPECT_EQ(stage_keys(job_with({{"lookup.filter", "pcf5"}})).exact, depth);
    EXPECT_EQ(stage_keys(job_with({vsm[0], {"method.kernel", "gaussian"}})).exact, depth);
    for (const scene::Override& verdict :
         {scene::Override{"shadow_map.depth_format", "d16"}, {"bias.slope", "1.5"}}) {
        EXPECT_EQ(stage_keys(job_with({verdict})).exact, depth) << verdict.key;
        EXPECT_EQ(stage_keys(job_with({vsm[0], verdict})).exact, depth) << verdict.key;
    }
    for (const scene::Override& place : {scene::Override{"shadow_map.resolution", "77"},
                                         {"lookup.outside", "clamp"},
                                         {"bias.normal_texels", "1.5"},
                                         {"camera.eye", "[1, 2, 9]"}}) {
        const std::string moved = stage_keys(job_with({place})).exact;
        EXPECT_NE(moved, depth) << place.key;
        EXPECT_EQ(stage_keys(job_with({vsm[0], place})).exact, moved) << place.key;
    }
}

} // namespace
} // namespace gnomon::analysis
