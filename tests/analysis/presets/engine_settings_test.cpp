#include "analysis/presets/engine_settings.hpp"

#include "analysis/metrics/map_results.hpp"
#include "methods/key_table.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::analysis {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// An orthographic map of 1000 texels across 20 m, from 2 m to 42 m: a texel is 0.02 m, a depth
/// unit 40 m.
scene::View sun_view()
{
    scene::LightFrustum map;
    map.left = map.bottom = -10;
    map.right_side = map.top = 10;
    map.near_m = 2;
    map.far_m = 42;
    scene::View view;
    view.light.type = scene::LightType::directional;
    view.maps = {map};
    return view;
}

scene::Job job_of_text(const std::string& text)
{
    return scene::job_of(scene::job_source_of_text("job.toml", text, {}, {}, methods::key_table()))
        .job;
}

scene::Job job_of(std::string_view keys)
{
    return job_of_text("scene.builtin = \"yard\"\nshadow_map.resolution = 1000\n" +
                       std::string{keys});
}

/// The median receiver; 0.04 m are 0.001 depth units and two texels.
EngineReceiver receiver_with(double constant_m)
{
    return {.light_distance_m = 20, .constant_m = constant_m};
}

EngineSettings translate(std::string_view engine, std::string_view keys = "",
                         const EngineReceiver& receiver = receiver_with(0.04))
{
    static std::vector<scene::Preset> all = scene::presets(*methods::key_table());
    const auto preset = std::ranges::find(all, engine, &scene::Preset::name);
    return engine_settings(*preset, job_of(keys), sun_view(), receiver);
}

double number(const EngineSettings& settings, std::string_view name)
{
    for (const EngineValue& value : settings.values) {
        if (value.setting->name == name) {
            return std::get<double>(value.value);
        }
    }
    ADD_FAILURE() << "no setting " << name;
    return 0;
}

TEST(EngineSettings, GiveTheSameLengthInEachEnginesUnitAndSign)
{
    // Each is one product of the length 0.04 m and exact factors: equal but for its rounding.
    EXPECT_DOUBLE_EQ(number(translate("three"), "light.shadow.bias"), -0.001);
    EXPECT_DOUBLE_EQ(number(translate("cesium"), "ShadowMap._primitiveBias.depthBias"), 0.001);
    EXPECT_DOUBLE_EQ(number(translate("bevy"), "DirectionalLight::shadow_depth_bias"), 0.04);
    EXPECT_DOUBLE_EQ(number(translate("godot"), "Light3D.shadow_bias"), 0.1); // percent of 40 m
    EXPECT_DOUBLE_EQ(number(translate("godot3"), "Light.shadow_bias"), 0.04);
    EXPECT_DOUBLE_EQ(number(translate("unity"), "UniversalRenderPipelineAsset.shadowDepthBias"), 2);
    EXPECT_DOUBLE_EQ(number(translate("unreal"), "ULightComponent::ShadowBias"), 0.4);
}

TEST(EngineSettings, DoubleBabylonsBiasWithAFilter)
{
    EXPECT_DOUBLE_EQ(
        number(translate("babylon", "lookup.filter = \"nearest\""), "shadowGenerator.bias"), 0.001);
    EXPECT_DOUBLE_EQ(
        number(translate("babylon", "lookup.filter = \"hardware\""), "shadowGenerator.bias"),
        0.002);
}

TEST(EngineSettings, AddUpAllBiasesAlongTheLight)
{
    const std::string keys = "bias.constant_texels = 3"; // 0.06 m, beside 0.04 m
    EXPECT_DOUBLE_EQ(number(translate("bevy", keys), "DirectionalLight::shadow_depth_bias"), 0.1);
    EXPECT_DOUBLE_EQ(number(translate("three", keys), "light.shadow.bias"), -0.0025);
}

TEST(EngineSettings, ConvertOffsetsAlongTheNormal)
{
    const std::string keys = "bias.normal_m = 0.03";
    EXPECT_DOUBLE_EQ(number(translate("three", keys), "light.shadow.normalBias"), 0.03);
    EXPECT_DOUBLE_EQ(number(translate("filament", keys), "ShadowOptions::normalBias"), 1.5);
}

TEST(EngineSettings, AreInUnitsOfTheScene)
{
    // The job's file has millimetres: 0.04 m are 40 units.
    scene::Job job = job_of("");
    job.scene.unit_m = 0.001;
    const scene::Preset bevy = scene::find_preset(*methods::key_table(), "bevy", "");
    EXPECT_DOUBLE_EQ(number(engine_settings(bevy, job, sun_view(), receiver_with(0.04)),
                            "DirectionalLight::shadow_depth_bias"),
                     40);
}

TEST(EngineSettings, OfASpotHoldAtTheReceiver)
{
    scene::View view = sun_view();
    view.light.type = scene::LightType::spot;
    scene::LightFrustum& map = view.maps.front();
    map.projection = scene::Projection::perspective;
    map.left = map.bottom = -1;
    map.right_side = map.top = 1;
    const scene::Preset three = scene::find_preset(*methods::key_table(), "three", "");
    const scene::Job job = job_of_text("scene.builtin = \"sphere-plane\"\n");
    const EngineSettings settings = engine_settings(three, job, view, receiver_with(0.04));
    // l / (A ζ (ζ − l)) with A = 1/2 − 1/42.
    EXPECT_DOUBLE_EQ(number(settings, "light.shadow.bias"),
                     -0.04 / ((0.5 - 1.0 / 42) * 20 * (20 - 0.04)));
    EXPECT_EQ(number(settings, "light.shadow.camera.near"), 2);
    EXPECT_EQ(number(settings, "light.shadow.camera.far"), 42);
    EXPECT_TRUE(settings.is_positional);
    EXPECT_EQ(settings.width_m, 40); // 2 · 20 m
}

TEST(EngineSettings, OfCascadesAreThoseOfTheMapThatIsRead)
{
    scene::View view = sun_view();
    view.maps.push_back(view.first_map());
    view.maps.back().left = view.maps.back().bottom = -20; // texels of 0.04 m
    view.maps.back().right_side = view.maps.back().top = 20;
    view.slices.ends = {10, 55};
    const scene::Preset unity = scene::find_preset(*methods::key_table(), "unity", "");
    const scene::Preset bevy = scene::find_preset(*methods::key_table(), "bevy", "");
    const scene::Job job = job_of("shadow_map.layout = \"cascades\"\nshadow_map.cascades = 2");
    EngineReceiver receiver = receiver_with(0.04);
    receiver.map = 1;
    EXPECT_DOUBLE_EQ(number(engine_settings(unity, job, view, receiver),
                            "UniversalRenderPipelineAsset.shadowDepthBias"),
                     1);
    EXPECT_EQ(number(engine_settings(bevy, job, view, receiver),
                     "CascadeShadowConfigBuilder::maximum_distance"),
              55);
}

TEST(EngineSettings, SayWhichNumberOfCascadesTheEngineHas)
{
    const auto mode = [](const char* count) {
        const EngineSettings settings = translate(
            "godot",
            std::string{"shadow_map.layout = \"cascades\"\nshadow_map.cascades = "} + count);
        for (const EngineValue& value : settings.values) {
            if (value.setting->name == "DirectionalLight3D.directional_shadow_mode") {
                return std::get<std::string>(value.value);
            }
        }
        return settings.cannot.front();
    };
    EXPECT_EQ(mode("2"), "DirectionalLight3D.SHADOW_PARALLEL_2_SPLITS");
    EXPECT_EQ(mode("3"), "shadow_map.cascades = 3");
    EXPECT_EQ(mode("4"), "DirectionalLight3D.SHADOW_PARALLEL_4_SPLITS");
}

TEST(EngineSettings, NameWhatTheEngineHasNoSettingFor)
{
    EXPECT_THAT(translate("openscenegraph").cannot, Contains("a bias of 0.04 m along the light"));
    EXPECT_FALSE(translate("openscenegraph").has_all_biases);
    EXPECT_TRUE(translate("three").has_all_biases);
    EXPECT_THAT(translate("three", "bias.receiver_plane = \"derivatives\"").cannot,
                Contains("bias.receiver_plane = \"derivatives\""));
    EXPECT_THAT(translate("three", "bias.slope_kernels = 1").cannot,
                Contains("bias.slope_kernels = 1"));
    EXPECT_THAT(translate("three", "lookup.filter = \"pcf9\"").cannot,
                Contains("lookup.filter = \"pcf9\""));
    EXPECT_THAT(translate("three",
                          "lookup.filter = \"hardware\"\nshadow_map.depth_format = \"d24\"",
                          receiver_with(0.04))
                    .cannot,
                IsEmpty());
}

TEST(EngineSettings, LetASettingServeTwoKeysOfOneValue)
{
    const EngineReceiver unbiased = receiver_with(0);
    const EngineSettings both = translate(
        "playcanvas", "bias.polygon_offset_factor = 4\nbias.polygon_offset_units = 4", unbiased);
    EXPECT_DOUBLE_EQ(number(both, "light.shadowBias"), 0.4);
    EXPECT_TRUE(both.has_all_biases);
    const EngineSettings apart = translate(
        "playcanvas", "bias.polygon_offset_factor = 4\nbias.polygon_offset_units = 2", unbiased);
    EXPECT_THAT(apart.cannot, Contains("bias.polygon_offset_units = 2"));
    EXPECT_FALSE(apart.has_all_biases);
}

TEST(EngineSettings, KeepToWhatTheEngineTakes)
{
    const EngineSettings settings = translate("unity", "", receiver_with(0.5)); // 25 texels
    EXPECT_EQ(number(settings, "UniversalRenderPipelineAsset.shadowDepthBias"), 10);
    EXPECT_THAT(settings.cannot, Contains(HasSubstr("shadowDepthBias above 10; 25 is needed")));
    EXPECT_FALSE(settings.has_all_biases);
}

TEST(EngineSettings, GiveAnEnginesOwnDefaultsBack)
{
    // The preset's keys are the defaults over their factors, and translate to the defaults again.
    for (const scene::Preset& preset : scene::presets(*methods::key_table())) {
        if (!preset.engine || !preset.is_for(scene::LightType::directional)) {
            continue;
        }
        const scene::Job job =
            job_of_text("preset = \"" + preset.name + "\"\nscene.builtin = \"yard\"\n");
        scene::View view = sun_view();
        view.bias = scene::resolve_bias(job.bias, view.first_map());
        const EngineReceiver receiver{.light_distance_m = 20,
                                      .constant_m = bias_in_map(job, view, 0, 20).constant_m};
        const EngineSettings settings = engine_settings(preset, job, view, receiver);
        for (const EngineValue& value : settings.values) {
            const auto& expected = value.setting->own_default;
            if (!expected) {
                continue;
            }
            if (const auto* number = std::get_if<double>(&*expected)) {
                // Depths are float32 in a view: a relative 2^-24 at most.
                EXPECT_NEAR(std::get<double>(value.value), *number, std::abs(*number) * 0x1p-24)
                    << preset.name << ": " << value.setting->name;
            } else {
                EXPECT_EQ(value.value, *expected) << preset.name << ": " << value.setting->name;
            }
        }
    }
}

} // namespace
} // namespace gnomon::analysis
