#include "store/exr/header.hpp"

#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

namespace gnomon::store {

namespace {

std::vector<std::string> numbers(std::initializer_list<double> values)
{
    std::vector<std::string> texts;
    for (const double value : values) {
        texts.push_back(hexadecimal(value));
    }
    return texts;
}

std::vector<std::string> numbers(const scene::Vec3d& v)
{
    return numbers({v.x, v.y, v.z});
}

std::vector<std::string> row_major(const scene::Mat4f& matrix)
{
    std::vector<std::string> texts;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            texts.push_back(hexadecimal(static_cast<double>(matrix[column][row])));
        }
    }
    return texts;
}

void add_light(std::vector<ExactInput>& inputs, const scene::Light& light)
{
    if (!light.has_position()) {
        inputs.push_back({"light_type", {"directional"}});
        inputs.push_back({"light_direction", numbers(light.direction)});
        return;
    }
    inputs.push_back({"light_type", {std::string{scene::light_type_name(light.type)}}});
    inputs.push_back({"light_position", numbers(light.position)});
    if (light.shines_all_round()) {
        return;
    }
    inputs.push_back({"light_axis", numbers(light.direction)});
    inputs.push_back({"cos_half_cone", numbers({light.cos_half_cone})});
}

void add_camera(std::vector<ExactInput>& inputs, const scene::Camera& camera)
{
    inputs.push_back({"projection", {std::string{scene::projection_name(camera.projection)}}});
    inputs.push_back({"eye", numbers(camera.eye)});
    inputs.push_back({"forward", numbers(camera.forward)});
    inputs.push_back({"right", numbers(camera.right)});
    inputs.push_back({"up", numbers(camera.up)});
    inputs.push_back({"half_height", numbers({camera.half_height})});
}

/// Adds the near and far planes; for cascades those of each map.
void add_planes(std::vector<ExactInput>& inputs, const scene::View& view)
{
    if (view.slices.ends.empty()) {
        inputs.push_back({"near", numbers({view.first_map().near_m})});
        inputs.push_back({"far", numbers({view.first_map().far_m})});
        return;
    }
    for (std::size_t i = 0; i < view.maps.size(); ++i) {
        inputs.push_back({fmt::format("near_{}", i), numbers({view.maps[i].near_m})});
        inputs.push_back({fmt::format("far_{}", i), numbers({view.maps[i].far_m})});
        inputs.push_back({fmt::format("slice_end_{}", i), numbers({double{view.slices.ends[i]}})});
    }
}

void add_map(std::vector<ExactInput>& inputs, const scene::View& view)
{
    for (std::size_t i = 0; i < view.maps.size(); ++i) {
        inputs.push_back({view.maps.size() == 1 ? "light_clip_from_world"
                                                : fmt::format("light_clip_from_world_{}", i),
                          row_major(view.maps[i].light_clip_from_world)});
    }
    add_planes(inputs, view);
    inputs.push_back({"bias_constant", numbers({static_cast<double>(view.bias.constant)})});
    inputs.push_back({"bias_slope", numbers({static_cast<double>(view.bias.slope)})});
    inputs.push_back(
        {"bias_normal_texels", numbers({static_cast<double>(view.bias.normal_texels)})});
    for (const auto& [key, bias] : view.bias.added) {
        if (bias != 0) {
            inputs.push_back({fmt::format("bias_{}", scene::key_leaf(key)),
                              numbers({static_cast<double>(bias)})});
        }
    }
}

void add_job(std::vector<ExrAttribute>& header, std::string_view prefix,
             const analysis::Comparison& comparison)
{
    header.push_back({fmt::format("{}job", prefix), job_json(comparison)});
}

void add_common(std::vector<ExrAttribute>& header, const analysis::Comparison& comparison)
{
    const analysis::Environment& environment = comparison.environment;
    header.push_back({"gnomon:scene", comparison.scene.name});
    header.push_back({"gnomon:scene_hash", comparison.scene.hash});
    header.push_back({"gnomon:truth_method", comparison.truth_method});
    header.push_back({"gnomon:gl_renderer", environment.gl_renderer});
    header.push_back({"gnomon:gl_version", environment.gl_version});
    header.push_back({"gnomon:embree", environment.embree});
    header.push_back({"gnomon:version", environment.gnomon});
}

void add_exact_inputs(std::vector<ExrAttribute>& header, std::string_view prefix,
                      const analysis::Comparison& comparison)
{
    for (const ExactInput& input : exact_inputs(comparison)) {
        header.push_back({fmt::format("{}{}", prefix, input.name),
                          fmt::format("{}", fmt::join(input.values, " "))});
    }
}

} // namespace

Json job_object(const analysis::Comparison& comparison)
{
    const auto& evaluation = comparison.evaluation;
    Json json = Json::object();
    for (const auto& [key, value] : scene::resolved_keys(comparison.job)) {
        if (evaluation &&
            std::ranges::find(evaluation->given_keys, key) == evaluation->given_keys.end()) {
            continue;
        }
        Json parsed = Json::parse(value, nullptr, false);
        json[key] = parsed.is_discarded() ? Json(value) : parsed;
    }
    return json;
}

std::string job_json(const analysis::Comparison& comparison)
{
    return json_text(job_object(comparison), -1);
}

std::string hexadecimal(double value)
{
    // The longest is 13 hexadecimal digits, a point and "p-1074".
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value),
                                   std::chars_format::hex)
                         .ptr;
    return (std::signbit(value) ? "-0x" : "0x") + std::string{buffer.data(), end};
}

std::vector<ExactInput> exact_inputs(const scene::View& view)
{
    std::vector<ExactInput> inputs;
    add_camera(inputs, view.camera);
    add_light(inputs, view.light);
    add_map(inputs, view);
    return inputs;
}

std::vector<ExactInput> exact_inputs(const analysis::Comparison& comparison)
{
    const auto& evaluation = comparison.evaluation;
    if (!evaluation) {
        return exact_inputs(comparison.view);
    }
    std::vector<ExactInput> inputs;
    if (evaluation->has_camera) {
        add_camera(inputs, comparison.view.camera);
    }
    add_light(inputs, comparison.view.light);
    if (evaluation->has_map) {
        add_map(inputs, comparison.view);
    }
    return inputs;
}

std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison)
{
    constexpr std::string_view prefix = "gnomon:";
    std::vector<ExrAttribute> header;
    add_job(header, prefix, comparison);
    add_common(header, comparison);
    add_exact_inputs(header, prefix, comparison);
    return header;
}

std::vector<ExrAttribute> exr_header(std::span<const analysis::Comparison> lights)
{
    std::vector<ExrAttribute> header;
    add_common(header, lights.front());
    for (const analysis::Comparison& comparison : lights) {
        const std::string prefix = fmt::format("gnomon:{}.", comparison.light);
        add_job(header, prefix, comparison);
        add_exact_inputs(header, prefix, comparison);
    }
    return header;
}

} // namespace gnomon::store
