#include "analysis/presets/engine_settings.hpp"

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

/// A bias of 0.001 depth units: 0.04 m, two texels.
ReceiverBias receiver_with(double constant_m)
{
    ReceiverBias receiver;
    receiver.light_distance_m = 20;
    receiver.texel_m = 0.02;
    receiver.bias = {constant_m / 40, constant_m, constant_m / 0.02, 0, 0};
    return receiver;
}

EngineSettings translate(std::string_view engine, std::string_view keys = "",
                         const ReceiverBias& receiver = receiver_with(0.04))
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
    EXPECT_DOUBLE_EQ(number(translate("godot"), "Light3D.shadow_bias"), 4);
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

TEST(EngineSettings, NameWhatTheEngineHasNoSettingFor)
{
    EXPECT_THAT(translate("openscenegraph").cannot, Contains("a bias of 0.04 m along the light"));
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

TEST(EngineSettings, KeepToWhatTheEngineTakes)
{
    const EngineSettings settings = translate("unity", "", receiver_with(0.5)); // 25 texels
    EXPECT_EQ(number(settings, "UniversalRenderPipelineAsset.shadowDepthBias"), 10);
    EXPECT_THAT(settings.cannot, Contains(HasSubstr("= 25, for it takes 0 to 10")));
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
        const EngineSettings settings = engine_settings(preset, job, view, bias_at(job, view, 20));
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
