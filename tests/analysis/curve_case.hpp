#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/limits/acne_free.hpp"
#include "analysis/lookup/bias_order.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// One pixel of a bias curve.
struct CurvePixel {
    scene::PixelClass pixel_class;
    float critical = 0;
    bool is_acne = false;
};

/// Pixels as images of one row, from which a bias curve is made.
struct CurveImages {
    scene::Image<float> criticals;
    scene::Image<scene::PixelClass> classes;
    PixelCauses causes;

    explicit CurveImages(const std::vector<CurvePixel>& pixels)
    {
        const scene::ImageSize size{static_cast<int>(pixels.size()), 1};
        criticals = scene::Image<float>{size};
        classes = scene::Image<scene::PixelClass>{size};
        causes.pixels = scene::Image<PixelCause>{size};
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            criticals[i] = pixels[i].critical;
            classes[i] = pixels[i].pixel_class;
            causes.pixels[i] = {Cause::resolution, Cause::resolution, pixels[i].is_acne};
        }
    }
    [[nodiscard]] FindAcneFree acne_free() const
    {
        return [this](std::span<const std::uint64_t> allowed) {
            return find_acne_free({classes, criticals, causes}, allowed);
        };
    }
    [[nodiscard]] BiasCurve curve() const { return {criticals, classes}; }
};

/// Counts pixel by pixel, following the definition.
inline ErrorCounts count_errors(const std::vector<CurvePixel>& pixels, float bias)
{
    ErrorCounts errors;
    for (const CurvePixel& pixel : pixels) {
        if (pixel.pixel_class == scene::PixelClass::lit && pixel.critical > bias) {
            ++errors.false_shadow;
        }
        if (pixel.pixel_class == scene::PixelClass::blocked && pixel.critical <= bias) {
            ++errors.false_lit;
        }
    }
    return errors;
}

/// A few pixels with many ties, infinities, zeros and both signs, and other classes in between.
inline std::vector<CurvePixel> random_pixels(std::mt19937& random)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::vector<CurvePixel> pixels(1 + random() % 60);
    for (CurvePixel& pixel : pixels) {
        switch (random() % 8) {
        case 0:
            pixel.critical = infinity;
            break;
        case 1:
            pixel.critical = -infinity;
            break;
        default:
            pixel.critical =
                std::ldexp(static_cast<float>(random() % 9) - 3.0F, random() % 2 == 0 ? -126 : -10);
        }
        constexpr std::array<scene::PixelClass, 3> classes{
            scene::PixelClass::lit, scene::PixelClass::blocked, scene::PixelClass::attached};
        pixel.pixel_class = classes.at(random() % 7 == 0 ? 2 : random() % 2);
        pixel.is_acne = random() % 2 == 0;
    }
    return pixels;
}

/// Every finite bias at which counts may change, and its neighbours.
inline std::vector<float> telling_biases(const std::vector<CurvePixel>& pixels)
{
    std::vector<float> biases{0.0F, bias_of_rank(largest_bias_rank),
                              bias_of_rank(-largest_bias_rank)};
    for (const CurvePixel& pixel : pixels) {
        if (std::isfinite(pixel.critical)) {
            biases.push_back(pixel.critical);
            biases.push_back(previous_bias(pixel.critical));
            biases.push_back(next_bias(pixel.critical));
        }
    }
    return biases;
}

} // namespace gnomon::analysis
