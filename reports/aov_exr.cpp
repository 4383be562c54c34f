#include "reports/aov_exr.hpp"

#include "reports/comparison_json.hpp"
#include "reports/exact_inputs.hpp"
#include "reports/image_encoding.hpp"
#include "reports/output_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon::reports {

namespace {

constexpr float not_a_bias = std::numeric_limits<float>::quiet_NaN();

std::uint32_t bits(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

float truth_code(scene::PixelClass pixel_class)
{
    if (!scene::is_scored(pixel_class)) {
        return -1.0F;
    }
    return pixel_class == scene::PixelClass::lit ? 1.0F : 0.0F;
}

std::vector<ExrChannel> channels(const analysis::Comparison& comparison,
                                 const scene::Image<scene::Vec3f>& points)
{
    using enum ChannelType;
    const auto& classes = comparison.truth.pixel_class;
    const auto& witness = comparison.truth.witness;
    const auto& triangle = comparison.receivers.triangle;
    const auto& samples = comparison.lookup.samples;
    std::vector<ExrChannel> channels{
        {"truth", float32, [&](std::size_t i) { return bits(truth_code(classes[i])); }},
        {"class", uint32, [&](std::size_t i) { return static_cast<std::uint32_t>(classes[i]); }},
        {"verdict", float32, [&](std::size_t i) { return bits(samples[i].verdict); }},
        {"prim", uint32, [&](std::size_t i) { return triangle[i]; }},
        {"P.X", float32, [&](std::size_t i) { return bits(points[i].x); }},
        {"P.Y", float32, [&](std::size_t i) { return bits(points[i].y); }},
        {"P.Z", float32, [&](std::size_t i) { return bits(points[i].z); }},
        {"witness", uint32, [&](std::size_t i) { return witness[i]; }},
        {"receiver_depth", float32, [&](std::size_t i) { return bits(samples[i].receiver_depth); }},
        {"map_depth", float32, [&](std::size_t i) { return bits(samples[i].map_depth); }},
    };
    if (comparison.diagnosis) {
        if (const auto& biases = comparison.diagnosis->biases) {
            const scene::Image<float>& critical = biases->critical_bias;
            channels.push_back({"critical_bias", float32, [&](std::size_t i) {
                                    return bits(is_scored(classes[i]) ? critical[i] : not_a_bias);
                                }});
            const analysis::BiasMap& map = biases->map;
            for (const auto& [name, image] : {std::pair{"needed_bias_m", &map.metres},
                                              std::pair{"needed_bias_texels", &map.texels},
                                              std::pair{"needed_bias_steps", &map.steps}}) {
                channels.push_back(
                    {name, float32, [image](std::size_t i) { return bits((*image)[i]); }});
            }
        }
        const analysis::CauseLayers& causes = comparison.diagnosis->causes;
        channels.push_back({"cause", uint32, [&](std::size_t i) {
                                return static_cast<std::uint32_t>(causes.cause[i]);
                            }});
        channels.push_back({"label", uint32, [&](std::size_t i) {
                                return static_cast<std::uint32_t>(causes.label[i]);
                            }});
    }
    return channels;
}

std::vector<ExrAttribute> attributes(const analysis::Comparison& comparison)
{
    const analysis::Environment& environment = comparison.environment;
    std::vector<ExrAttribute> result{
        {"gnomon:job", job_json(comparison.job)},
        {"gnomon:scene", comparison.scene.name},
        {"gnomon:scene_hash", comparison.scene.hash},
        {"gnomon:truth_method", comparison.truth_method},
        {"gnomon:gl_renderer", environment.gl_renderer},
        {"gnomon:gl_version", environment.gl_version},
        {"gnomon:embree", environment.embree},
        {"gnomon:version", environment.gnomon},
    };
    for (const ExactInput& input : exact_inputs(comparison.view)) {
        result.push_back({"gnomon:" + input.name, fmt::format("{}", fmt::join(input.values, " "))});
    }
    return result;
}

} // namespace

void write_aov(const std::filesystem::path& path, const analysis::Comparison& comparison,
               const scene::Image<scene::Vec3f>& points)
{
    const scene::ImageSize size = comparison.truth.pixel_class.size();
    if (points.size() != size) {
        throw std::invalid_argument(fmt::format(
            "write_aov: points are {}x{} but the image is {}x{}", points.size().width_px,
            points.size().height_px, size.width_px, size.height_px));
    }
    write_file(path, encode_exr(size, channels(comparison, points), attributes(comparison)));
}

} // namespace gnomon::reports
