// The configurations of a sweep, and the question to each curve.

#include "analysis/sweep/sweep_curves.hpp"

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* hash = "0123456789abcdef";

scene::SweepSpace space_of(const std::vector<std::string>& axes,
                           const std::vector<scene::Override>& overrides = {})
{
    return {scene::builtin_job_source("wall", overrides), axes};
}

/// All configurations in the order of their ordinals.
std::vector<Configuration> describe_all(const scene::SweepSpace& space,
                                        std::string_view scene_hash = hash,
                                        const std::string& version = "1.0",
                                        bool keeps_every_bias = false)
{
    const SweepCurves sweep_curves{space, keeps_every_bias, version};
    std::vector<Configuration> all;
    const auto visit = [&](const Configuration& configuration) { all.push_back(configuration); };
    for (std::size_t i = 0; i < sweep_curves.requests().size(); ++i) {
        sweep_curves.describe(i, {std::string{scene_hash}, ""}, visit);
    }
    for (const Refusal& refusal : sweep_curves.refusals()) {
        sweep_curves.describe(refusal, visit);
    }
    std::sort(all.begin(), all.end(),
              [](const Configuration& a, const Configuration& b) { return a.ordinal < b.ordinal; });
    return all;
}

Configuration only_one(const std::vector<scene::Override>& overrides,
                       const std::vector<std::string>& axes = {})
{
    const auto all = describe_all(space_of(axes, overrides));
    EXPECT_THAT(all, SizeIs(1));
    return all.at(0);
}

TEST(SweepCurves, DescribesEveryConfigurationOnce)
{
    const auto all = describe_all(space_of({"bias.constant=0,0.5", "bias.slope=0,1,2"}));
    ASSERT_THAT(all, SizeIs(6));
    std::set<std::string> ids;
    std::set<std::string> curves;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].ordinal, i);
        EXPECT_EQ(all[i].scene_hash, hash);
        EXPECT_EQ(all[i].case_name, "");
        EXPECT_THAT(all[i].id, ::testing::MatchesRegex("[0-9a-f]{16}"));
        ids.insert(all[i].id);
        curves.insert(all[i].curve);
    }
    EXPECT_EQ(ids.size(), 6U);
    EXPECT_EQ(curves.size(), 3U);
    EXPECT_EQ(all[0].curve, all[3].curve);
}

TEST(SweepCurves, WritesEveryKeyOut)
{
    const scene::SweepSpace space =
        space_of({"bias.constant=0,0.5", "lookup.filter=pcf3,hardware"});
    for (const Configuration& configuration : describe_all(space)) {
        EXPECT_EQ(configuration.parameters,
                  scene::resolved_keys(space.job(space.at(configuration.ordinal))))
            << configuration.ordinal;
    }
}

TEST(SweepCurves, NamesEqualJobsEqually)
{
    EXPECT_EQ(only_one({}).id, only_one({}).id);
    EXPECT_EQ(only_one({}).id, only_one({{"bias.slope", "0"}}).id);
    EXPECT_EQ(only_one({{"bias.slope", "0.5"}}).id, only_one({}, {"bias.slope=0.5"}).id);
    // Runs on disk depend on this: with a changed id, a sweep starts anew.
    const auto rows = describe_all(space_of({"bias.slope=0,1", "bias.constant=0,0.5"}));
    const auto turned = describe_all(space_of({"bias.constant=0,0.5", "bias.slope=0,1"}));
    EXPECT_EQ(rows[1].id, turned[2].id);
    EXPECT_EQ(rows[2].id, turned[1].id);
    EXPECT_EQ(rows[1].curve, turned[2].curve);
}

TEST(SweepCurves, NamesAConfigurationAlikeWhereverTheSweepEnds)
{
    const auto few = describe_all(space_of({"bias.constant=0.5"}));
    const auto many = describe_all(space_of({"bias.constant={from=0, to=1, count=5}"}));
    EXPECT_EQ(few[0].id, many[2].id);
    EXPECT_EQ(few[0].curve, many[2].curve);
    // Keeping pixels changes the work, but no id.
    const auto kept = describe_all(space_of({"bias.constant=0.5"}), hash, "1.0", true);
    EXPECT_EQ(few[0].id, kept[0].id);
    EXPECT_EQ(few[0].curve, kept[0].curve);
}

TEST(SweepCurves, NamesJobsThatDifferInAnyKeyDifferently)
{
    const std::vector<scene::Override> changes{{"scene.ground", "true"},
                                               {"scene.no_cast", "[\"a\"]"},
                                               {"camera.eye", "[1, 2, 3]"},
                                               {"camera.up", "[0, 0, 1]"},
                                               {"image.width", "77"},
                                               {"image.height", "77"},
                                               {"light.direction", "[0, -1, 0.5]"},
                                               {"shadow_map.resolution", "77"},
                                               {"shadow_map.depth_format", "u8"},
                                               {"shadow_map.fit", "camera"},
                                               {"shadow_map.roll_deg", "7"},
                                               {"shadow_map.near", "-77"},
                                               {"shadow_map.far", "77"},
                                               {"shadow_map.cull", "back"},
                                               {"shadow_map.reversed", "true"},
                                               {"lookup.filter", "pcf3"},
                                               {"lookup.outside", "clamp"},
                                               {"bias.constant", "0.5"},
                                               {"bias.constant_m", "0.5"},
                                               {"bias.slope", "0.5"},
                                               {"bias.normal_texels", "0.5"}};
    std::map<std::string, std::string> by_id{{only_one({}).id, "nothing"}};
    for (const scene::Override& change : changes) {
        const auto [entry, is_new] = by_id.emplace(only_one({change}).id, change.key);
        EXPECT_TRUE(is_new) << change.key << " and " << entry->second;
    }
}

TEST(SweepCurves, NamesScenesByContentAndNotByPlace)
{
    const auto of_file = [](const char* file, const char* scene_hash) {
        return describe_all(space_of({"bias.slope=0.5"}, {{"scene.file", file}}), scene_hash)[0];
    };
    EXPECT_EQ(of_file("a.obj", hash).id, of_file("b/c.obj", hash).id);
    EXPECT_EQ(of_file("a.obj", hash).curve, of_file("b/c.obj", hash).curve);
    EXPECT_NE(of_file("a.obj", hash).id, of_file("a.obj", "0123456789abcdee").id);
    EXPECT_NE(of_file("a.obj", hash).curve, of_file("a.obj", "0123456789abcdee").curve);
}

TEST(SweepCurves, NamesScenesByWhatIsTakenFromTheirFilesToo)
{
    const scene::SweepSpace space = space_of({}, {{"scene.file", "a.gltf"}});
    const SweepCurves sweep_curves{space, false, "1.0"};
    const auto described = [&](const SceneIdentity& identity) {
        Configuration only;
        sweep_curves.describe(0, identity, [&](const Configuration& one) { only = one; });
        EXPECT_EQ(sweep_curves.task(0, identity).id, only.curve);
        EXPECT_EQ(only.scene_hash, hash) << "of the triangles alone";
        return only;
    };
    const Configuration none = described({hash, ""});
    const Configuration one = described({hash, "\ncamera.eye=[1, 2, 3]"});
    const Configuration other = described({hash, "\ncamera.eye=[1, 2, 4]"});
    EXPECT_NE(none.id, one.id);
    EXPECT_NE(none.curve, one.curve);
    EXPECT_NE(one.id, other.id);
    EXPECT_NE(one.curve, other.curve);
    EXPECT_EQ(one.id, described({hash, "\ncamera.eye=[1, 2, 3]"}).id);
    EXPECT_EQ(one.parameters, none.parameters) << "the job still says nothing of it";
}

TEST(SweepCurves, SharesNoStageBetweenFiles)
{
    const scene::SweepSpace space =
        space_of({"scene.file=a.gltf,b.gltf", "shadow_map.fit=scene,camera"});
    const SweepCurves sweep_curves{space, false, "1.0"};
    ASSERT_THAT(sweep_curves.requests(), SizeIs(4));
    const StageKeys& a = sweep_curves.requests()[0].keys;
    const StageKeys& b = sweep_curves.requests()[2].keys;
    for (const auto member :
         {&StageKeys::scene, &StageKeys::light, &StageKeys::truth, &StageKeys::frustum,
          &StageKeys::receivers, &StageKeys::texels, &StageKeys::map, &StageKeys::exact,
          &StageKeys::lookup, &StageKeys::curve}) {
        EXPECT_NE(a.*member, b.*member) << a.*member;
    }
}

TEST(SweepCurves, NamesResultsOfAnotherVersionDifferently)
{
    const scene::SweepSpace space = space_of({});
    EXPECT_NE(describe_all(space, hash, "1.0")[0].id, describe_all(space, hash, "1.1")[0].id);
    EXPECT_NE(describe_all(space, hash, "1.0")[0].curve, describe_all(space, hash, "1.1")[0].curve);
}

TEST(SweepCurves, LeavesTheConstantBiasOutOfTheCurvesName)
{
    EXPECT_EQ(only_one({}).curve, only_one({{"bias.constant", "0.5"}}).curve);
    EXPECT_EQ(only_one({}).curve, only_one({{"bias.constant_m", "0.5"}}).curve);
    EXPECT_NE(only_one({}).curve, only_one({{"bias.slope", "0.5"}}).curve);
    EXPECT_NE(only_one({}).curve, only_one({{"lookup.filter", "linear"}}).curve);
}

TEST(SweepCurves, PutsAllBiasesOfALookupIntoOneCurve)
{
    const scene::SweepSpace space =
        space_of({"lookup.filter=hardware,linear", "bias.constant=0,0.25,0.5"});
    const auto all = describe_all(space);
    EXPECT_EQ(all[0].curve, all[2].curve);
    EXPECT_EQ(all[3].curve, all[4].curve);
    EXPECT_NE(all[0].curve, all[3].curve);
    const SweepCurves sweep_curves{space, false, "1.0"};
    ASSERT_THAT(sweep_curves.requests(), SizeIs(2));
    EXPECT_THAT(sweep_curves.requests()[0].ordinals, ElementsAre(0, 1, 2));
}

TEST(SweepCurves, AsksForEveryBiasByItselfToKeepPixels)
{
    const scene::SweepSpace space = space_of({"bias.slope=0,1", "bias.constant=0,0.25,0.5"});
    EXPECT_THAT((SweepCurves{space, false, "1.0"}.requests()), SizeIs(2));
    const SweepCurves sweep_curves{space, true, "1.0"};
    ASSERT_THAT(sweep_curves.requests(), SizeIs(6));
    std::set<std::string> lookups;
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_THAT(sweep_curves.requests()[i].ordinals, ElementsAre(i));
        lookups.insert(sweep_curves.requests()[i].keys.lookup);
    }
    EXPECT_EQ(lookups.size(), 6U);
}

TEST(SweepCurves, SaysHowLargeImageAndMapAre)
{
    const scene::SweepSpace space = space_of(
        {}, {{"image.width", "30"}, {"image.height", "20"}, {"shadow_map.resolution", "16"}});
    const SweepCurves sweep_curves{space, false, "1.0"};
    EXPECT_EQ(sweep_curves.requests()[0].pixels, 600U);
    EXPECT_EQ(sweep_curves.requests()[0].texels, 256U);
}

TEST(SweepCurves, AsksOfACurveTheJobsOwnBiasAndThoseOfItsRows)
{
    const scene::SweepSpace space =
        space_of({"bias.slope=1,2", "bias.constant=0,0.25,0.5"}, {{"shadow_map.cull", "front"}});
    const SweepCurves sweep_curves{space, false, "1.0"};
    const SweepTask task = sweep_curves.task(1, {hash, ""});
    EXPECT_EQ(task.id, describe_all(space)[4].curve);
    EXPECT_EQ(task.job.bias.slope, 2);
    EXPECT_EQ(task.job.bias.constant, 0);
    EXPECT_EQ(task.job.shadow_map.cull, scene::Cull::front);
    ASSERT_THAT(task.rows, SizeIs(3));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(task.rows[i].ordinal, 3 + i);
        EXPECT_EQ(task.rows[i].bias.slope, 2);
        EXPECT_EQ(task.rows[i].bias.constant, 0.25 * static_cast<double>(i));
    }
}

TEST(SweepCurves, KnowsTheFilesBiasBesideTheAxes)
{
    scene::JobSource source = scene::builtin_job_source("wall", {});
    source.cases.push_back({"plain", {}});
    source.cases.push_back(
        {"biased", scene::layer_from_overrides(*source.keys, {{"bias.constant", "0.125"}})});
    source.cases.push_back(
        {"metres", scene::layer_from_overrides(*source.keys, {{"bias.constant_m", "0.25"}})});
    const scene::SweepSpace space{source, {"bias.slope=1"}};
    const SweepCurves sweep_curves{space, false, "1.0"};
    ASSERT_THAT(sweep_curves.requests(), SizeIs(3));
    EXPECT_EQ(sweep_curves.task(0, {hash, ""}).job.bias.constant, 0);
    EXPECT_EQ(sweep_curves.task(1, {hash, ""}).job.bias.constant, 0.125);
    EXPECT_EQ(sweep_curves.task(1, {hash, ""}).rows.at(0).bias.constant, 0.125);
    EXPECT_EQ(sweep_curves.task(2, {hash, ""}).job.bias.constant_m, 0.25);
    EXPECT_EQ(sweep_curves.task(2, {hash, ""}).rows.at(0).bias.constant_m, 0.25);
    const auto all = describe_all(space);
    EXPECT_EQ(all[2].case_name, "metres");
    EXPECT_EQ(all[0].job_bias, "0.05 m") << "the built-in's own";
    EXPECT_EQ(all[1].job_bias, "0.125");
    EXPECT_EQ(all[2].job_bias, "0.25 m");
}

TEST(SweepCurves, PutsMetresInPlaceOfDepthUnits)
{
    const scene::SweepSpace space =
        space_of({"bias.constant_m=0.25,0.5"}, {{"shadow_map.cull", "front"}});
    const SweepTask task = SweepCurves{space, false, "1.0"}.task(0, {hash, ""});
    EXPECT_EQ(task.job.bias.constant_m, 0.05) << "the built-in's own";
    ASSERT_THAT(task.rows, SizeIs(2));
    EXPECT_EQ(task.rows[0].bias.constant_m, 0.25);
    EXPECT_EQ(task.rows[1].bias.constant_m, 0.5);
    const auto all = describe_all(space);
    EXPECT_NE(all[0].id, all[1].id);
    EXPECT_EQ(all[0].curve, all[1].curve);
}

TEST(SweepCurves, RefusesConfigurationsWhoseKeysDoNotGoTogether)
{
    const scene::SweepSpace space =
        space_of({"shadow_map.near=1,5", "shadow_map.far=4,9", "bias.constant=0,0.5"});
    const SweepCurves sweep_curves{space, false, "1.0"};
    EXPECT_THAT(sweep_curves.requests(), SizeIs(3));
    ASSERT_THAT(sweep_curves.refusals(), SizeIs(1));
    const Refusal& refusal = sweep_curves.refusals()[0];
    EXPECT_THAT(refusal.ordinals, ElementsAre(4, 5));
    EXPECT_THAT(refusal.message, HasSubstr("must be less than shadow_map.far"));
    const auto all = describe_all(space);
    ASSERT_THAT(all, SizeIs(8));
    std::set<std::string> ids;
    for (const Configuration& configuration : all) {
        ids.insert(configuration.id);
    }
    EXPECT_EQ(ids.size(), 8U);
    using Pair = std::pair<std::string, std::string>;
    EXPECT_THAT(all[5].parameters,
                ElementsAre(Pair{"scene.builtin", "\"wall\""}, Pair{"shadow_map.near", "5"},
                            Pair{"shadow_map.far", "4"}, Pair{"bias.constant", "0.5"}));
    EXPECT_EQ(all[5].scene_hash, "");
    EXPECT_EQ(all[4].curve, all[5].curve);
}

TEST(SweepCurves, NamesRefusedConfigurationsByEveryKeyOfTheirJob)
{
    const auto refused = [](const std::vector<scene::Override>& more) {
        std::vector<scene::Override> keys{{"shadow_map.near", "5"}, {"shadow_map.far", "4"}};
        keys.insert(keys.end(), more.begin(), more.end());
        return describe_all(space_of({"bias.slope=0.5"}, keys)).at(0);
    };
    EXPECT_EQ(refused({}).id, refused({}).id);
    // Another job refuses other rows of the same axes.
    EXPECT_NE(refused({}).id, refused({{"light.direction", "[0, -1, 0.5]"}}).id);
    EXPECT_NE(refused({}).curve, refused({{"light.direction", "[0, -1, 0.5]"}}).curve);
    EXPECT_NE(refused({{"scene.file", "a.obj"}}).id, refused({{"scene.file", "b.obj"}}).id);
    const Configuration biased = refused({{"bias.constant", "0.5"}});
    EXPECT_NE(refused({}).id, biased.id);
    EXPECT_EQ(refused({}).curve, biased.curve);
}

TEST(SweepCurves, NamesScenesThatCannotBeReadByTheirPlace)
{
    const auto of_file = [](const char* file) {
        return describe_all(space_of({"bias.slope=0.5"}, {{"scene.file", file}}), "")[0];
    };
    EXPECT_EQ(of_file("a.obj").id, of_file("a.obj").id);
    EXPECT_NE(of_file("a.obj").id, of_file("b.obj").id);
    EXPECT_NE(of_file("a.obj").curve, of_file("b.obj").curve);
    EXPECT_EQ(of_file("a.obj").scene_hash, "");
}

TEST(SweepCurves, MayRefuseEverything)
{
    const scene::SweepSpace space = space_of({"shadow_map.near=5,6"}, {{"shadow_map.far", "4"}});
    const SweepCurves sweep_curves{space, false, "1.0"};
    EXPECT_THAT(sweep_curves.requests(), IsEmpty());
    EXPECT_THAT(sweep_curves.refusals(), SizeIs(2));
}

TEST(SweepCurves, ListsItsCurvesInTheOrderOfTheirFirstConfigurations)
{
    const scene::SweepSpace space =
        space_of({"bias.constant=0,0.5", "shadow_map.resolution=16,32,64"});
    const SweepCurves sweep_curves{space, false, "1.0"};
    ASSERT_THAT(sweep_curves.requests(), SizeIs(3));
    EXPECT_THAT(sweep_curves.requests()[0].ordinals, ElementsAre(0, 3));
    EXPECT_THAT(sweep_curves.requests()[1].ordinals, ElementsAre(1, 4));
    EXPECT_THAT(sweep_curves.requests()[2].ordinals, ElementsAre(2, 5));
    EXPECT_EQ(sweep_curves.job(2).shadow_map.resolution_texels, 64);
}

} // namespace
} // namespace gnomon::analysis
