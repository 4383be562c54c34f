#include "reports/page/image_layers.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "scene/infinity.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace gnomon::reports {

namespace {

/// Equal bits, or both NaN.
bool are_same(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

/// The value of a job's key; `otherwise` if the method lacks it, or for another renderer's case.
template <typename Value>
Value setting_of(const store::Json& detail, const char* key, Value otherwise)
{
    return detail.at("job").value(key, otherwise);
}

/// A placeholder without a map, where no value uses texels or depths.
store::Json frustum_of(const store::Json& detail)
{
    const store::Json& own = detail.at("frustum");
    if (!own.is_null()) {
        return own;
    }
    return {{"projection", "orthographic"},
            {"near_m", 0.0},
            {"far_m", 1.0},
            {"reversed", false},
            {"texel_m", 1.0}};
}

double constant_bias_of(const store::Json& detail)
{
    const store::Json& inputs = detail.at("exact_inputs");
    if (!inputs.contains("bias_constant")) {
        return 0;
    }
    return std::strtod(inputs.at("bias_constant").get_ref<const std::string&>().c_str(), nullptr);
}

} // namespace

PixelRules::PixelRules(const store::Json& detail)
    : frustum(frustum_of(detail)), // braces would make an array
      filter{detail.at("job").value("lookup.filter",
                                    std::string{detail.contains("evaluate") ? "nearest" : ""})},
      slope{setting_of<double>(detail, "bias.slope", 0)},
      outside{setting_of<std::string>(detail, "lookup.outside", "lit")},
      bias{constant_bias_of(detail)},
      texel_side_m{frustum.at("texel_m").get<double>()}
{
    format = scene::depth_format_from_name(
        setting_of<std::string>(detail, "shadow_map.depth_format", ""));
    light.projection = frustum.at("projection") == "perspective" ? scene::Projection::perspective
                                                                 : scene::Projection::orthographic;
    light.content =
        scene::map_content_from_name(frustum.value("content", "")).value_or(light.content);
    light.near_m = frustum.at("near_m").get<double>();
    light.far_m = frustum.at("far_m").get<double>();
    light.reversed = frustum.at("reversed").get<bool>();
}

ImageLayers::ImageLayers(store::LayerFile& file, const PixelRules& rules)
    : rules_{rules},
      classes_{file.classes()},
      receiver_depth_{file.floats("receiver_depth")},
      map_depth_{file.floats("map_depth")},
      has_biases_{file.has("critical_bias")},
      has_diagnosis_{file.has("light_distance_m")}
{
    if (has_diagnosis_) {
        light_distance_m_ = file.floats("light_distance_m");
    }
    if (has_biases_) {
        critical_ = file.floats("critical_bias");
        needed_m_ = file.floats("needed_bias_m");
        needed_texels_ = file.floats("needed_bias_texels");
    }
}

std::vector<std::uint32_t> ImageLayers::critical_steps() const
{
    std::vector<std::uint32_t> steps(classes_.pixel_count());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (scene::is_scored(classes_[i])) {
            const float above = receiver_depth_[i] - map_depth_[i];
            const float difference = rules_.light.reversed ? -above : above;
            const float start = std::isnormal(difference) ? difference : 0.0F;
            steps[i] = static_cast<std::uint32_t>(analysis::bias_rank(critical_[i])) -
                       static_cast<std::uint32_t>(analysis::bias_rank(start));
        }
    }
    return steps;
}

bool ImageLayers::can_derive_lengths() const
{
    const auto holds = [&](std::size_t i) {
        const double bias{limit(i)};
        const double light_distance_m{light_distance_m_[i]};
        const double length_m = analysis::bias_length_m(rules_.light, bias, light_distance_m);
        const double texels = length_m / rules_.texel_m(light_distance_m);
        return are_same(static_cast<float>(length_m), needed_m_[i]) &&
               are_same(static_cast<float>(texels), needed_texels_[i]);
    };
    return has_biases_ && has_diagnosis_ && all_scored(holds);
}

float ImageLayers::limit(std::size_t i) const
{
    const bool is_allowed = scene::is_blocked(classes_[i]) && critical_[i] != scene::infinity;
    return is_allowed ? analysis::previous_bias(critical_[i]) : critical_[i];
}

template <typename Holds>
bool ImageLayers::all_scored(const Holds& holds) const
{
    for (std::size_t i = 0; i < classes_.pixel_count(); ++i) {
        if (scene::is_scored(classes_[i]) && !holds(i)) {
            return false;
        }
    }
    return true;
}

} // namespace gnomon::reports
