#include "reports/json/comparison_json.hpp"

#include "example_comparison.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/exr/header.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cstdlib>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using nlohmann::json;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

json parsed(const analysis::Comparison& comparison)
{
    return json::parse(comparison_json(comparison));
}

std::vector<std::string> names(const json& object)
{
    std::vector<std::string> result;
    for (const auto& [name, value] : object.items()) {
        result.push_back(name);
    }
    return result;
}

TEST(ComparisonJson, HasEveryFixedName)
{
    const json object = parsed(store::example().comparison);
    EXPECT_THAT(names(object),
                IsSupersetOf({"schema", "pixels", "unmatched_kinds", "indeterminate_kinds",
                              "false_shadow", "false_lit", "false_shadow_rate", "false_lit_rate",
                              "error_rate", "mean_abs_error", "causes", "labels",
                              "peter_panning_gap_m", "bias_curve", "environment", "seconds"}));
    EXPECT_THAT(names(object["pixels"]),
                UnorderedElementsAre("total", "background", "unmatched", "attached", "out_of_light",
                                     "indeterminate", "lit", "blocked"));
    EXPECT_THAT(names(object["unmatched_kinds"]), UnorderedElementsAre("snap", "tie", "mismatch"));
    EXPECT_THAT(names(object["indeterminate_kinds"]),
                UnorderedElementsAre("silhouette", "vertex", "graze"));
    EXPECT_THAT(names(object["environment"]),
                UnorderedElementsAre("gl_renderer", "gl_version", "embree", "gnomon"));
    EXPECT_THAT(names(object["seconds"]),
                UnorderedElementsAre("scene", "bvh", "receivers", "shadow_map", "lookup", "truth",
                                     "analysis"));
    EXPECT_THAT(names(object["peter_panning_gap_m"]), UnorderedElementsAre("median", "p95", "max"));
}

TEST(ComparisonJson, GivesTheMeasuredNumbers)
{
    const analysis::Comparison& comparison = store::example().comparison;
    const analysis::Metrics& metrics = comparison.metrics;
    const json object = parsed(comparison);
    EXPECT_EQ(object["schema"], 2);
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        EXPECT_EQ(object["pixels"][std::string{scene::pixel_class_names[i]}],
                  metrics.pixels.by_class[i]);
    }
    EXPECT_EQ(object["pixels"]["total"], 96 * 64);
    EXPECT_EQ(object["unmatched_kinds"]["snap"], metrics.pixels.of(scene::ClassReason::snap));
    EXPECT_EQ(object["indeterminate_kinds"]["silhouette"],
              metrics.pixels.of(scene::ClassReason::silhouette));
    EXPECT_EQ(object["false_shadow"], metrics.false_shadow);
    EXPECT_EQ(object["false_lit"], metrics.false_lit);
    // Doubles are printed with enough digits to read back the same bits.
    EXPECT_EQ(object["error_rate"].get<double>(), *metrics.error_rate);
    EXPECT_EQ(object["mean_abs_error"].get<double>(), *metrics.mean_abs_error);
    EXPECT_GT(metrics.false_shadow, 0U) << "the example should have errors of both kinds";
    EXPECT_GT(metrics.false_lit, 0U);
}

TEST(ComparisonJson, PrintsNoNumberThatNobodyComputed)
{
    const json object = parsed(store::example().comparison);
    EXPECT_TRUE(object["causes"].is_null());
    EXPECT_TRUE(object["labels"].is_null());
    EXPECT_TRUE(object["bias_curve"].is_null());
    EXPECT_TRUE(object["peter_panning_gap_m"]["median"].is_null());
}

TEST(ComparisonJson, NamesSceneAndMethod)
{
    const json object = parsed(store::example().comparison);
    EXPECT_EQ(object["scene"]["name"], "example.obj");
    EXPECT_EQ(object["scene"]["triangles"], store::example().file.scene.triangles.size());
    EXPECT_EQ(object["scene"]["objects"], 3);
    EXPECT_EQ(object["scene"]["hash"], scene::content_hash(store::example().file.scene));
    EXPECT_THAT(names(object["scene"]),
                UnorderedElementsAre("name", "triangles", "objects", "dropped_triangles",
                                     "ignored_primitives", "hash", "notes"));
    EXPECT_EQ(object["truth_method"], "exact");
}

TEST(ComparisonJson, WritesTheNotesOnTheScene)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.scene.notes = {};
    EXPECT_EQ(parsed(comparison)["scene"]["notes"], json::array());
    comparison.scene.notes = {{"alpha_mask", 2, "2 materials are cut out"}};
    EXPECT_EQ(parsed(comparison)["scene"]["notes"],
              json::parse(R"([{"kind":"alpha_mask","count":2,"text":"2 materials are cut out"}])"));
}

TEST(ComparisonJson, WritesJobValuesInTheirTypes)
{
    const json job = parsed(store::example().comparison)["job"];
    EXPECT_EQ(job["shadow_map.resolution"], 48);
    EXPECT_EQ(job["shadow_map.depth_format"], "d24");
    EXPECT_EQ(job["bias.constant"], 0.002);
    EXPECT_EQ(job["camera.eye"], json::array({2.5, 3.2, 5.5}));
    EXPECT_EQ(job.size(), scene::resolved_keys(store::example().comparison.job).size());
    EXPECT_EQ(json::parse(store::job_json(store::example().comparison)), job);
}

TEST(ComparisonJson, WritesExactInputsThatReadBackToTheSameBits)
{
    const scene::View& view = store::example().comparison.view;
    const json inputs = parsed(store::example().comparison)["exact_inputs"];
    const auto number = [](const json& text) {
        return std::strtod(text.get<std::string>().c_str(), nullptr);
    };
    const auto vector = [&](const json& texts) {
        return scene::Vec3d{number(texts[0]), number(texts[1]), number(texts[2])};
    };
    EXPECT_EQ(vector(inputs["eye"]), view.camera.eye);
    EXPECT_EQ(vector(inputs["forward"]), view.camera.forward);
    EXPECT_EQ(vector(inputs["right"]), view.camera.right);
    EXPECT_EQ(vector(inputs["up"]), view.camera.up);
    EXPECT_EQ(number(inputs["half_height"]), view.camera.half_height);
    EXPECT_EQ(vector(inputs["light_direction"]), view.light.direction);
    EXPECT_EQ(number(inputs["near"]), view.first_map().near_m);
    EXPECT_EQ(number(inputs["far"]), view.first_map().far_m);
    EXPECT_EQ(static_cast<float>(number(inputs["bias_constant"])), view.bias.constant);
    ASSERT_EQ(inputs["light_clip_from_world"].size(), 16U);
    for (int i = 0; i < 16; ++i) {
        EXPECT_EQ(number(inputs["light_clip_from_world"][static_cast<std::size_t>(i)]),
                  static_cast<double>(view.first_map().light_clip_from_world[i % 4][i / 4]))
            << "row " << i / 4 << ", column " << i % 4;
    }
}

TEST(ComparisonJson, WritesTheSpotsOwnInputs)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.view.light = {scene::LightType::spot, {0, -1, 0}, {1, 2, 3}, 0.75};
    const json inputs = parsed(comparison)["exact_inputs"];
    EXPECT_EQ(inputs["light_type"], "spot");
    EXPECT_EQ(inputs["light_position"], json::array({"0x1p+0", "0x1p+1", "0x1.8p+1"}));
    EXPECT_EQ(inputs["light_axis"], json::array({"0x0p+0", "-0x1p+0", "0x0p+0"}));
    EXPECT_EQ(inputs["cos_half_cone"], "0x1.8p-1");
    EXPECT_FALSE(inputs.contains("light_direction"));
}

TEST(ComparisonJson, WritesNullForARateWithoutADenominator)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.metrics = {};
    const json object = parsed(comparison);
    for (const char* rate :
         {"false_shadow_rate", "false_lit_rate", "error_rate", "mean_abs_error"}) {
        EXPECT_TRUE(object[rate].is_null()) << rate;
    }
    EXPECT_EQ(object["false_shadow"], 0);
}

TEST(ComparisonJson, SurvivesANameThatIsNoUtf8)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.scene.name = "caf\xE9.obj";
    EXPECT_EQ(parsed(comparison)["scene"]["name"], "caf\xEF\xBF\xBD.obj");
}

} // namespace
} // namespace gnomon::reports
