#include "analysis/evaluate/case_checks.hpp"

#include "analysis/evaluate/likely_mistakes.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Light;
using scene::PixelClass;

/// Whether another reading of the case explains the mask far better: it must be good, better by a
/// fifth of the largest agreement, and leave less than a third of the disagreement. Shadow errors
/// cannot make a wrong reading that good: they would have to be the shadows of that reading.
bool explains_better(double other, double given)
{
    return other >= 0.5 && other - given >= 0.2 && 1 - other <= 0.3 * (1 - given);
}

/// The stricter rule for another light, which changes everything that is lit: it must be right
/// nearly everywhere, and the given one at most half-way. A light that scores few pixels may suit
/// them by chance, so it must be right at more than half as many as the given one scores.
bool explains_far_better(const MaskAgreement& other, const MaskAgreement& given)
{
    return other.has_both() && other.index() >= 0.8 && given.index() <= 0.5 &&
           explains_better(other.index(), given.index()) &&
           2 * (other.lit_right + other.blocked_right) > given.lit + given.blocked;
}

/// Classes of the pixels that the flipped image judges too.
Image<PixelClass> judged_in_both(const Image<PixelClass>& classes,
                                 const Image<scene::Vec3f>& points, const Flip& flip)
{
    const auto [width, height] = classes.size();
    Image<PixelClass> result = classes;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (std::isnan(flip.read(points, x, y).x)) {
                result(x, y) = PixelClass::background;
            }
        }
    }
    return result;
}

/// The mistake of a mask that is flipped against P, and perhaps inverted too.
std::optional<ImportMistake> check_flips(const scene::CaseLayers& layers,
                                         const Image<PixelClass>& classes)
{
    double best = 0;
    std::optional<ImportMistake> mistake;
    for (const Flip& flip : all_flips) {
        const auto both = judged_in_both(classes, layers.position, flip);
        const double given = agreement(layers.mask, both).index();
        const double turned = agreement(flip.flipped(layers.mask), both).index();
        for (const bool inverts : {false, true}) {
            const double index = inverts ? -turned : turned;
            if (index > best + 0.01 && explains_better(index, given)) {
                best = index;
                mistake = ImportMistake{
                    "flipped_image",
                    fmt::format(
                        "the mask is flipped against P: its {} are in the opposite order{}; "
                        "an image begins at its top left, and conventions.rows says "
                        "otherwise{}",
                        flip.words(), inverts ? ", and it is inverted" : "",
                        inverts ? ", and a mask is 1 where lit" : "")};
            }
        }
    }
    return mistake;
}

/// Some receivers, evenly spread, as one row, with their part of the mask.
struct Tried {
    scene::RoundedReceivers receivers;
    Image<float> mask;
};

Tried spread_pixels(const scene::RoundedReceivers& receivers, const Image<float>& mask)
{
    const std::vector<std::size_t> pixels = checked_pixels(receivers.position);
    const scene::ImageSize size{static_cast<int>(pixels.size()), 1};
    Tried tried{{Image<scene::Vec3f>{size}, {}, receivers.eye, {}, receivers.most_distance_m},
                Image<float>{size}};
    if (!receivers.normal.empty()) {
        tried.receivers.normal = Image<scene::Vec3f>{size};
    }
    if (!receivers.object.empty()) {
        tried.receivers.object = Image<std::uint32_t>{size};
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t pixel = pixels[i];
        tried.receivers.position[i] = receivers.position[pixel];
        tried.mask[i] = mask[pixel];
        if (!receivers.normal.empty()) {
            tried.receivers.normal[i] = receivers.normal[pixel];
        }
        if (!receivers.object.empty()) {
            tried.receivers.object[i] = receivers.object[pixel];
        }
    }
    return tried;
}

/// The light as another convention of axes would place it.
Light turned(Light light, const MixedAxes& axes)
{
    light.direction = mixed(axes, light.direction);
    light.position = mixed(axes, light.position);
    return light;
}

/// Another place of the light, and the mistake that would explain it.
struct OtherLight {
    Light light;
    ImportMistake mistake;
};

std::vector<OtherLight> other_lights(const Light& light)
{
    std::vector<OtherLight> others;
    if (!light.shines_all_round()) {
        Light reversed = light;
        reversed.direction = -light.direction;
        others.push_back(
            {reversed,
             {"light_side", "the light seems to shine the other way: light.direction is the way "
                            "the light travels, from the light to the scene"}});
    }
    for (const MixedAxes& axes : all_axes()) {
        if (axes == all_axes().front()) {
            continue;
        }
        const bool is_left = mirrors(axes);
        others.push_back(
            {turned(light, axes),
             {is_left ? "handedness" : "axes",
              fmt::format("the mask fits a light with the axes {}: light and P are not in the same "
                          "space{}",
                          axes_text(axes), is_left ? "; they differ in handedness" : "")}});
    }
    return others;
}

std::optional<ImportMistake> check_lights(const Light& light, const scene::RoundedReceivers& all,
                                          const Image<float>& mask,
                                          const renderers::RoundedReference& finders)
{
    const Tried tried = spread_pixels(all, mask);
    const MaskAgreement given =
        agreement(tried.mask, finders.find_rounded_truth(light, tried.receivers).truth.pixel_class);
    double best = given.index();
    std::optional<ImportMistake> mistake;
    for (OtherLight& other : other_lights(light)) {
        const scene::RoundedTruth truth = finders.find_rounded_truth(other.light, tried.receivers);
        const MaskAgreement found = agreement(tried.mask, truth.truth.pixel_class);
        // Of lights that fit alike the first is the likeliest.
        if (explains_far_better(found, given) && found.index() > best + 0.01) {
            best = found.index();
            mistake = std::move(other.mistake);
        }
    }
    return mistake;
}

bool has_both_verdicts(const scene::CaseLayers& layers)
{
    bool has_lit = false;
    bool has_shadow = false;
    for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
        if (!std::isnan(layers.position[i].x)) {
            (scene::is_lit(layers.mask[i]) ? has_lit : has_shadow) = true;
        }
    }
    return has_lit && has_shadow;
}

} // namespace

bool shows_shading_alone(const scene::CaseLayers& layers, const Light& light,
                         const scene::RoundedTruth& truth, const scene::TriangleScene& mesh)
{
    std::array<std::uint64_t, 2> counts{}; // dark, lit
    std::array<std::uint64_t, 2> in_cast_shadow{};
    std::uint64_t differing = 0;
    for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
        const PixelClass pixel_class = truth.truth.pixel_class[i];
        if (truth.triangle[i] == scene::no_triangle ||
            (!scene::is_scored(pixel_class) && pixel_class != PixelClass::attached)) {
            continue;
        }
        const bool is_lit = scene::is_lit(layers.mask[i]);
        const bool faces_light = glm::dot(winding_normal(mesh, truth.triangle[i]),
                                          light.way_from(scene::Vec3d{layers.position[i]})) > 0;
        ++counts.at(is_lit ? 1 : 0);
        differing += is_lit == faces_light ? 0 : 1;
        if (faces_light && scene::is_blocked(pixel_class)) {
            ++in_cast_shadow.at(is_lit ? 1 : 0);
        }
    }
    return counts[0] > 0 && counts[1] > 0 && differing * 100 <= counts[0] + counts[1] &&
           in_cast_shadow[0] * 10 <= in_cast_shadow[1];
}

double MaskAgreement::index() const
{
    const auto share = [](std::uint64_t right, std::uint64_t all) {
        return all > 0 ? static_cast<double>(right) / static_cast<double>(all) : 0.5;
    };
    return share(lit_right, lit) + share(blocked_right, blocked) - 1;
}

double MaskAgreement::darkening() const
{
    return has_both()
               ? lit_light / static_cast<double>(lit) - blocked_light / static_cast<double>(blocked)
               : 0;
}

MaskAgreement agreement(const Image<float>& mask, const Image<PixelClass>& classes)
{
    MaskAgreement found;
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        const bool says_lit = scene::is_lit(mask[i]);
        if (scene::is_lit(classes[i])) {
            ++found.lit;
            found.lit_light += double{mask[i]};
            found.lit_right += says_lit ? 1U : 0U;
        } else {
            ++found.blocked;
            found.blocked_light += double{mask[i]};
            found.blocked_right += says_lit ? 0 : 1;
        }
    }
    return found;
}

std::optional<ImportMistake> check_mask(const scene::CaseLayers& layers, const Light& light,
                                        const scene::RoundedReceivers& receivers,
                                        const scene::RoundedTruth& truth,
                                        const renderers::RoundedReference& finders)
{
    const Image<PixelClass>& classes = truth.truth.pixel_class;
    const MaskAgreement given = agreement(layers.mask, classes);
    if (!has_both_verdicts(layers)) {
        return std::nullopt;
    }
    if (given.has_both() && explains_better(-given.index(), given.index())) {
        return ImportMistake{"inverted_mask",
                             "the mask is inverted: it is 1 where the truth is shadow and 0 where "
                             "it is light; a mask is 1 where lit"};
    }
    if (auto mistake = check_flips(layers, classes)) {
        return mistake;
    }
    if (given.index() > 0.5) { // nothing can explain it far better
        return std::nullopt;
    }
    return check_lights(light, receivers, layers.mask, finders);
}

} // namespace gnomon::analysis
