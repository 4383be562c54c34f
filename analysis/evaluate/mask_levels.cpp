#include "analysis/evaluate/case_checks.hpp"

#include "methods/job_method.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;
using scene::Vec3d;

/// Values that differ by less are one level: a little over two steps of 8 bits.
constexpr double level_width = 0.01;

/// A mask's value, and the cosine of the light's angle there.
struct Shade {
    double value = 0;
    double cosine = 0;
};

/// The lit pixels that some light fell on.
std::vector<Shade> shades(const scene::CaseLayers& layers, const scene::Light& light,
                          const scene::RoundedTruth& truth, const scene::TriangleScene& mesh)
{
    std::vector<Shade> found;
    for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
        if (!scene::is_lit(truth.truth.pixel_class[i]) || double{layers.mask[i]} <= level_width) {
            continue;
        }
        const Vec3d normal = winding_normal(mesh, truth.triangle[i]);
        const Vec3d to_light = light.way_from(Vec3d{layers.position[i]});
        found.push_back(
            {double{layers.mask[i]},
             std::abs(glm::dot(normal, to_light)) / (glm::length(normal) * glm::length(to_light))});
    }
    return found;
}

/// The light that an sRGB-encoded value stands for.
double decoded(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Whether the values are proportional to the cosine: the fit leaves at most a twentieth of their
/// variation unexplained, and they vary by more than rounding.
bool follow_cosine(const std::vector<Shade>& shades, double (*light_of)(double))
{
    double values = 0;
    double products = 0;
    double squares = 0;
    for (const auto& [value, cosine] : shades) {
        values += light_of(value);
        products += light_of(value) * cosine;
        squares += cosine * cosine;
    }
    const auto count = static_cast<double>(shades.size());
    double unexplained = 0;
    double variation = 0;
    for (const auto& [value, cosine] : shades) {
        const double left = light_of(value) - products / squares * cosine;
        const double apart = light_of(value) - values / count;
        unexplained += left * left;
        variation += apart * apart;
    }
    return variation > count * level_width * level_width && unexplained * 20 <= variation;
}

bool is_shaded(const std::vector<Shade>& shades)
{
    constexpr std::size_t fewest = 16;
    return shades.size() >= fewest && (follow_cosine(shades, [](double value) { return value; }) ||
                                       follow_cosine(shades, decoded));
}

/// How many pixels have the mask's least value, and how many its largest.
struct EndCounts {
    std::size_t least = 0;
    std::size_t largest = 0;
    std::size_t all = 0;
};

/// The least and the largest value of a mask, and who has them.
struct Levels {
    double least = 1;
    double largest = 0;
    EndCounts judged;
    EndCounts lit;
    EndCounts blocked;

    Levels(const scene::CaseLayers& layers, const scene::Image<PixelClass>& classes)
    {
        const auto for_each = [&](const auto& add) {
            for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
                if (!std::isnan(layers.position[i].x)) {
                    add(double{layers.mask[i]}, classes[i]);
                }
            }
        };
        for_each([&](double value, PixelClass) {
            least = std::min(least, value);
            largest = std::max(largest, value);
        });
        for_each([&](double value, PixelClass pixel_class) {
            count(judged, value);
            if (scene::is_scored(pixel_class)) {
                count(scene::is_lit(pixel_class) ? lit : blocked, value);
            }
        });
    }

    /// Whether they are more than a step apart, and not 0 and 1.
    [[nodiscard]] bool are_unusual() const
    {
        return largest - least > 2 * level_width &&
               (least > 2 * level_width || largest < 1 - 2 * level_width);
    }
    /// Whether nearly every pixel has one of the two.
    [[nodiscard]] bool are_all() const
    {
        constexpr std::size_t fewest = 4;
        return judged.least >= fewest && judged.largest >= fewest &&
               (judged.least + judged.largest) * 10 >= judged.all * 9;
    }
    /// Whether most lit pixels have one of them, and most blocked ones the other.
    [[nodiscard]] bool are_of_truth() const
    {
        const auto divide = [](std::size_t lit_there, const EndCounts& of_lit,
                               std::size_t blocked_there, const EndCounts& of_blocked) {
            return of_lit.all > 0 && of_blocked.all > 0 && lit_there * 2 >= of_lit.all &&
                   blocked_there * 2 >= of_blocked.all;
        };
        return divide(lit.largest, lit, blocked.least, blocked) ||
               divide(lit.least, lit, blocked.largest, blocked);
    }
    /// Whether the larger value means shadowed.
    [[nodiscard]] bool are_inverted() const
    {
        return lit.least * blocked.all + blocked.largest * lit.all >
               lit.largest * blocked.all + blocked.least * lit.all;
    }

private:
    void count(EndCounts& ends, double value) const
    {
        ++ends.all;
        ends.least += value - least <= level_width ? 1U : 0U;
        ends.largest += largest - value <= level_width ? 1U : 0U;
    }
};

/// Whether the lookup's own filter explains all values.
bool are_shares_of_taps(const scene::CaseFile& file, const scene::Job& job,
                        const scene::CaseLayers& layers)
{
    const bool is_told = file.says("lookup.filter") || file.says("method.name");
    const int taps = is_told ? methods::traits(job).equal_taps() : 0;
    return taps > 0 && std::ranges::all_of(layers.mask, [taps](float value) {
               const double share = double{value} * taps;
               return std::abs(share - std::nearbyint(share)) <= 0x1p-20 * taps;
           });
}

bool is_fraction(float verdict)
{
    constexpr float step = 1e-3F; // nearer to 0 or 1 it is rounding
    return verdict > step && verdict < 1 - step;
}

} // namespace

std::optional<ImportMistake> check_levels(const scene::CaseFile& file, const scene::Job& job,
                                          const scene::CaseLayers& layers,
                                          const scene::Light& light,
                                          const scene::RoundedTruth& truth,
                                          const scene::TriangleScene& mesh)
{
    const scene::ImageConventions& conventions = file.conventions;
    if (conventions.mask_range || conventions.lit_above || are_shares_of_taps(file, job, layers)) {
        return std::nullopt;
    }
    if (is_shaded(shades(layers, light, truth, mesh))) {
        return ImportMistake{
            "shading", "the mask is light times the cosine of its angle (N·L), not the shadow "
                       "alone: write the shadow before it is multiplied, or, where no filter "
                       "softens it, set channels.lit_above = 0"};
    }
    const Levels levels{layers, truth.truth.pixel_class};
    if (!levels.are_unusual() || (!levels.are_all() && !levels.are_of_truth())) {
        return std::nullopt;
    }
    const double dark = levels.are_inverted() ? levels.largest : levels.least;
    const double bright = levels.are_inverted() ? levels.least : levels.largest;
    return ImportMistake{
        "mask_range",
        fmt::format("the mask is {0:.4g} where shadowed and {1:.4g} where lit, in place of 0 and "
                    "1: set channels.mask_range = [{0:.4g}, {1:.4g}]",
                    dark, bright)};
}

std::optional<ImportMistake> check_fractions(const scene::CaseFile& file, const scene::Job& job,
                                             const scene::CaseLayers& layers)
{
    const bool is_filtered = (file.says("lookup.filter") || file.says("method.name")) &&
                             !methods::traits(job).has_one_tap();
    if (is_filtered || file.conventions.has_fractions || file.conventions.mask_range) {
        return std::nullopt;
    }
    const auto [width, height] = layers.size();
    std::size_t fractions = 0;
    std::size_t edges = 0;
    const auto is_edge = [&](int x, int y, int other_x, int other_y) {
        return other_x < width && other_y < height &&
               !std::isnan(layers.position(other_x, other_y).x) &&
               scene::is_lit(layers.mask(x, y)) != scene::is_lit(layers.mask(other_x, other_y));
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (!std::isnan(layers.position(x, y).x)) {
                fractions += is_fraction(layers.mask(x, y)) ? 1U : 0U;
                edges += is_edge(x, y, x + 1, y) || is_edge(x, y, x, y + 1) ? 1U : 0U;
            }
        }
    }
    if (fractions < 4 || fractions * 10 < edges) {
        return std::nullopt;
    }
    return ImportMistake{
        "anti_aliased",
        fmt::format("the mask is anti-aliased: {} pixels are neither lit nor shadowed; render one "
                    "sample at the pixel's centre without denoising, or, if a filter of the lookup "
                    "made them, set lookup.filter or channels.fractions = true",
                    fractions)};
}

} // namespace gnomon::analysis
