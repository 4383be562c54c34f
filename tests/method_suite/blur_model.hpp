#pragma once

#include "method_case.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tests {

/// A blurred map's kernel, as values of its keys.
struct BlurChoice {
    const char* kernel = "box";
    int width_texels = 1;

    [[nodiscard]] std::vector<scene::Override> keys() const;
    /// Radius in texels that contains everything a lookup reads.
    [[nodiscard]] int reach_texels() const { return width_texels / 2 + 1; }
};

/// A blurred map's value at a lookup, in double.
struct BlurredNumber {
    double value = 0;  ///< interpolated
    double spread = 0; ///< range of the four interpolated texels
};

/// A blurred map in double: a function of each depth, averaged by the kernel, then transformed by
/// `after`.
class BlurModel {
public:
    using Function = std::function<double(double)>;

    /// @param depths  of a square map, top left first.
    BlurModel(
        const scene::Image<float>& depths, const BlurChoice& blur, const Function& content,
        const Function& after = [](double mean) { return mean; });

    /// @param texels  of a map, lower left first.
    explicit BlurModel(scene::Image<double> texels) : texels_{std::move(texels)} {}

    /// Beyond the edge the nearest texel repeats.
    [[nodiscard]] BlurredNumber number_at(const scene::Vec2d& texel) const;
    [[nodiscard]] double at(const scene::Vec2f& texel) const { return number_at(texel).value; }
    [[nodiscard]] double spread_at(const scene::Vec2f& texel) const
    {
        return number_at(texel).spread;
    }
    /// Lower left first.
    [[nodiscard]] const scene::Image<double>& texels() const { return texels_; }

private:
    scene::Image<double> texels_; ///< lower left first
};

/// The largest error of a driver's interpolation weights: the product of uv and the map's 64 texels
/// and a difference round; other drivers keep 8 bits.
[[nodiscard]] double interpolation_error();

/// The side of the modelled maps.
inline constexpr int model_side_texels = 64;

/// Settings for small images and maps without bias.
[[nodiscard]] std::vector<scene::Override> model_keys(const std::string& method);

/// A pixel whose lookup reads nothing beyond the map's edge.
struct InnerPixel {
    std::size_t pixel = 0;
    scene::Vec2f texel;
    double receiver_depth = 0;
    double verdict = 0;
};
[[nodiscard]] std::vector<InnerPixel> inner_pixels(MethodCase& c, int reach_texels);

} // namespace gnomon::tests
