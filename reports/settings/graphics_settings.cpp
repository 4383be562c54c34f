#include "reports/settings/graphics_settings.hpp"

#include "analysis/comparison/comparison.hpp"
#include "methods/job_method.hpp"
#include "reports/settings/lookup_shader.hpp"
#include "reports/tune/tuned_setting.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

namespace gnomon::reports {
namespace {

using analysis::TunedSetting;

constexpr auto names =
    std::to_array<std::string_view>({"glsl", "hlsl", "gl", "direct3d", "vulkan"});

/// The name of an API among `api_states`; empty for a shader language.
std::string_view state_name(GraphicsTarget target)
{
    switch (target) {
    case GraphicsTarget::gl:
        return "GL";
    case GraphicsTarget::direct3d:
        return "Direct3D";
    case GraphicsTarget::vulkan:
        return "Vulkan";
    case GraphicsTarget::glsl:
    case GraphicsTarget::hlsl:
        break;
    }
    return {};
}

/// The job's setting with the chosen biases.
TunedSetting setting_of(const analysis::Comparison& comparison, const analysis::BiasChoice& choice)
{
    const scene::BiasSettings& bias = comparison.job.bias;
    TunedSetting setting = own_setting(comparison.job);
    analysis::RoundedBias& rounded = setting.bias.rounded;
    setting.slope = choice.slope ? double{*choice.slope} : setting.slope;
    if (choice.recommended != nullptr) {
        rounded = choice.recommended->rounded;
    } else {
        rounded.bias = comparison.view.bias.constant;
        rounded.unit = &scene::bias_unit_of(bias);
        rounded.value = scene::constant_in_unit(bias);
    }
    return setting;
}

void add_states(GraphicsSettings& settings, const analysis::Comparison& comparison,
                const TunedSetting& setting)
{
    settings.cannot = other_biases(comparison.job);
    if (!settings.cannot.empty()) {
        settings.lose_bias();
    }
    const auto states =
        api_states(setting, methods::map_offset(comparison.job, comparison.view), settings.cannot);
    settings.lines = std::ranges::find(states, state_name(settings.target), &ApiState::api)->lines;
}

} // namespace

std::span<const std::string_view> graphics_target_names()
{
    return names;
}

std::optional<GraphicsTarget> graphics_target_from_name(std::string_view name)
{
    const auto found = std::ranges::find(names, scene::lower_case(name));
    return found == names.end()
               ? std::nullopt
               : std::optional{static_cast<GraphicsTarget>(std::distance(names.begin(), found))};
}

std::string_view graphics_target_title(GraphicsTarget target)
{
    switch (target) {
    case GraphicsTarget::glsl:
        return "GLSL";
    case GraphicsTarget::hlsl:
        return "HLSL";
    case GraphicsTarget::gl:
        return "OpenGL";
    case GraphicsTarget::direct3d:
        return "Direct3D 12";
    case GraphicsTarget::vulkan:
        return "Vulkan";
    }
    return {};
}

GraphicsSettings graphics_settings(GraphicsTarget target, const analysis::Comparison& comparison,
                                   const analysis::BiasChoice& choice)
{
    const std::string& method = comparison.job.method.name;
    if (method != "depth" && method != "pcf") {
        throw scene::InputError(fmt::format("method.name = \"{}\": Gnomon writes code for depth "
                                            "maps; set it with --set method.name=depth",
                                            method));
    }
    GraphicsSettings settings{analysis::chosen_bias(comparison, choice), target};
    const TunedSetting setting = setting_of(comparison, choice);
    if (!state_name(target).empty()) {
        add_states(settings, comparison, setting);
        return settings;
    }
    LookupShader shader = lookup_shader(
        target == GraphicsTarget::hlsl ? ShaderLanguage::hlsl : ShaderLanguage::glsl,
        choice.job(comparison.job), choice.view(comparison.view), setting.bias.rounded.bias);
    if (!shader.has_all_biases) {
        settings.lose_bias();
    }
    settings.lines = std::move(shader.lines);
    settings.cannot = std::move(shader.cannot);
    return settings;
}

} // namespace gnomon::reports
