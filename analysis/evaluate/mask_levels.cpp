#include "analysis/evaluate/mask_levels.hpp"

#include "methods/job_method.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;
using scene::Vec3d;

/// Values that differ by less are one level: two steps of 8 bits, and a little.
constexpr double level_width = 0.01;

/// A mask's value on a surface that the light meets at some angle.
struct Shade {
    double value = 0;
    double cosine = 0;
};

/// Of lit pixels on which some light fell.
std::vector<Shade> shades(const scene::CaseLayers& layers, const scene::Light& light,
                          const scene::RoundedTruth& truth, const scene::TriangleScene& mesh)
{
    std::vector<Shade> found;
    for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
        if (!scene::is_lit(truth.truth.pixel_class[i]) || double{layers.mask[i]} <= level_width) {
            continue;
        }
        const auto corners = mesh.corners(truth.triangle[i]);
        const Vec3d a{corners[0]};
        const Vec3d normal = glm::cross(Vec3d{corners[1]} - a, Vec3d{corners[2]} - a);
        const Vec3d to_light = light.way_from(Vec3d{layers.position[i]});
        found.push_back(
            {double{layers.mask[i]},
             std::abs(glm::dot(normal, to_light)) / (glm::length(normal) * glm::length(to_light))});
    }
    return found;
}

/// Light of a value that was encoded for a screen, as sRGB is.
double decoded(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Whether the values are proportional to the cosine: what that leaves unexplained is at most a
/// twentieth of how they vary, and they vary by more than rounding.
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

/// How many of some pixels have the mask's least value, and how many its largest.
struct AtEnds {
    std::size_t least = 0;
    std::size_t largest = 0;
    std::size_t all = 0;
};

/// The ends of a mask's values.
struct Levels {
    double least = 1;
    double largest = 0;
    AtEnds judged;
    AtEnds lit;
    AtEnds blocked;

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

    /// More than a step apart, and not 0 and 1.
    [[nodiscard]] bool are_unusual() const
    {
        return largest - least > 2 * level_width &&
               (least > 2 * level_width || largest < 1 - 2 * level_width);
    }
    /// Nearly every pixel has one of the two.
    [[nodiscard]] bool are_all() const
    {
        constexpr std::size_t fewest = 4;
        return judged.least >= fewest && judged.largest >= fewest &&
               (judged.least + judged.largest) * 10 >= judged.all * 9;
    }
    /// Most lit pixels have the one, and most blocked ones the other.
    [[nodiscard]] bool are_of_truth() const
    {
        const auto divide = [](std::size_t lit_there, const AtEnds& of_lit,
                               std::size_t blocked_there, const AtEnds& of_blocked) {
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
    void count(AtEnds& ends, double value) const
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

} // namespace gnomon::analysis
