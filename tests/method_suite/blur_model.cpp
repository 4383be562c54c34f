#include "blur_model.hpp"

#include "methods/prefiltered/blur.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::tests {
namespace {

/// Averages along x; beyond the edge the nearest texel repeats.
scene::Image<double> averaged_along_x(const scene::Image<double>& image,
                                      std::span<const float> weights)
{
    const auto [width, height] = image.size();
    const int reach = static_cast<int>(weights.size()) / 2;
    scene::Image<double> averaged{image.size()};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int column = x - reach;
            for (const float weight : weights) {
                averaged(x, y) += double{weight} * image(std::clamp(column, 0, width - 1), y);
                ++column;
            }
        }
    }
    return averaged;
}

scene::Image<double> transposed(const scene::Image<double>& image)
{
    const auto [width, height] = image.size();
    scene::Image<double> turned{{height, width}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            turned(y, x) = image(x, y);
        }
    }
    return turned;
}

} // namespace

std::vector<scene::Override> BlurChoice::keys() const
{
    return {{"method.kernel", kernel}, {"method.kernel_width", std::to_string(width_texels)}};
}

BlurModel::BlurModel(const scene::Image<float>& depths, const BlurChoice& blur,
                     const Function& content, const Function& after)
    : texels_{depths.size()}
{
    const auto [width, height] = depths.size();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            texels_(x, y) = content(double{depths(x, height - 1 - y)});
        }
    }
    const auto weights = methods::blur_kernel(blur.kernel, blur.width_texels).weights;
    texels_ = averaged_along_x(texels_, weights);
    texels_ = transposed(averaged_along_x(transposed(texels_), weights));
    for (std::size_t i = 0; i < texels_.pixel_count(); ++i) {
        texels_[i] = after(texels_[i]);
    }
}

BlurredNumber BlurModel::number_at(const scene::Vec2d& texel) const
{
    const int last = texels_.size().width_px - 1;
    const double x = texel.x - 0.5;
    const double y = texel.y - 0.5;
    const auto of = [&](int column, int row) {
        return texels_(std::clamp(static_cast<int>(std::floor(x)) + column, 0, last),
                       std::clamp(static_cast<int>(std::floor(y)) + row, 0, last));
    };
    const std::array<double, 4> four{of(0, 0), of(1, 0), of(0, 1), of(1, 1)};
    const double u = x - std::floor(x);
    const double v = y - std::floor(y);
    const auto [least, greatest] = std::ranges::minmax(four);
    return {(1 - v) * ((1 - u) * four[0] + u * four[1]) + v * ((1 - u) * four[2] + u * four[3]),
            greatest - least};
}

double interpolation_error()
{
    return shader_arithmetic_is_ieee() ? model_side_texels * 0x1p-23 : 0x1p-8;
}

std::vector<scene::Override> model_keys(const std::string& method)
{
    return {{"method.name", method},
            {"image.width", "160"},
            {"image.height", "90"},
            {"shadow_map.resolution", std::to_string(model_side_texels)},
            {"shadow_map.depth_format", "d32f"},
            {"lookup.outside", "clamp"},
            {"bias.constant", "0"},
            {"bias.slope", "0"},
            {"bias.normal_texels", "0"}};
}

std::vector<InnerPixel> inner_pixels(MethodCase& c, int reach_texels)
{
    const auto lookup = c.look_up();
    const auto triangles = c.triangles();
    const auto first = static_cast<float>(reach_texels);
    const auto last = static_cast<float>(c.job.shadow_map.resolution_texels - reach_texels);
    std::vector<InnerPixel> inner;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        const scene::Vec2f texel = lookup.texels[i];
        if (triangles[i] != scene::no_triangle && std::min(texel.x, texel.y) > first &&
            std::max(texel.x, texel.y) < last) {
            inner.push_back({i, texel, double{lookup.samples[i].receiver_depth},
                             double{lookup.samples[i].verdict}});
        }
    }
    return inner;
}

} // namespace gnomon::tests
