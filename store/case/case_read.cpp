#include "store/case/case_files.hpp"

#include "scene/geometry/triangles.hpp"
#include "scene/job/file.hpp"
#include "scene/text.hpp"
#include "store/case/case_image_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using scene::CaseLayers;
using scene::Vec3f;

constexpr float no_position = std::numeric_limits<float>::quiet_NaN();

/// The names of the channels in this file. A colour target holds P in R, G and B, and the mask in
/// A. If the mask has its own channel, the colour is P unless the case has a camera.
scene::ChannelNames names_in(CaseImageFile& file, scene::ChannelNames names, bool has_camera)
{
    const bool has_mask = !file.find(names.shadow).empty();
    if (file.find_vector(names.position) || !file.has("R") || !file.has("G") || !file.has("B")) {
        return names;
    }
    if (!has_mask && file.has("A")) {
        names.shadow = {"A"};
        names.position = {""};
    } else if (has_mask && !has_camera) {
        names.position = {""};
    }
    return names;
}

/// Whether case.toml names the position's channels.
bool names_position(const scene::ChannelNames& names)
{
    return names.position != scene::ChannelNames{}.position && names.position.size() == 1;
}

/// @param may_lack_it  the camera gives the positions; the result is then empty.
scene::Image<Vec3f> read_position(CaseImageFile& file, const std::vector<std::string>& names,
                                  bool may_lack_it)
{
    const auto channels = file.find_vector(names);
    if (!channels && may_lack_it) {
        return {};
    }
    if (!channels) {
        file.refuse(
            fmt::format("no channel {}.X: the world position of each pixel is required, or the "
                        "whole camera; {}; channels.position gives it another name; "
                        "`gnomon capture-kit` writes what makes it",
                        scene::one_line(names.front()), file.listing()));
    }
    constexpr std::string_view why =
        "near 100 half's step is 0.0625, and no shadow can be judged from there; write full floats";
    const auto x = file.exact_numbers((*channels)[0], why);
    const auto y = file.exact_numbers((*channels)[1], why);
    const auto z = file.exact_numbers((*channels)[2], why);
    scene::Image<Vec3f> position{file.size()};
    for (std::size_t i = 0; i < position.pixel_count(); ++i) {
        position[i] = {x[i], y[i], z[i]};
    }
    return position;
}

bool is_finite(const Vec3f& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Nonzero where a pixel is to be judged; empty if the file does not say.
scene::Image<float> read_valid(CaseImageFile& file, const std::vector<std::string>& names)
{
    const std::string name = file.find(names);
    auto valid = name.empty() ? scene::Image<float>{} : file.numbers(name);
    for (std::size_t i = 0; i < valid.pixel_count(); ++i) {
        if (std::isnan(valid[i])) {
            file.refuse_pixel(name, "valid is NaN", i, "write 1 or 0");
        }
    }
    return valid;
}

/// Placeholders for positions that the camera gives: 0, or NaN where a pixel is not to be judged.
scene::Image<Vec3f> placeholder_positions(CaseImageFile& file, const scene::ChannelNames& names)
{
    const auto valid = read_valid(file, names.valid);
    const std::string mask_name = file.find(names.shadow);
    const auto mask = mask_name.empty() ? scene::Image<float>{} : file.numbers(mask_name);
    scene::Image<Vec3f> places{file.size()};
    for (std::size_t i = 0; i < places.pixel_count(); ++i) {
        if ((!valid.empty() && valid[i] == 0) || (!mask.empty() && std::isnan(mask[i]))) {
            places[i] = Vec3f{no_position};
        }
    }
    return places;
}

/// Sets positions to NaN where a pixel is not to be judged.
/// @param name  of P's first channel.
void mask_positions(CaseImageFile& file, const std::string& name,
                    const scene::CaseFile& description, scene::Image<Vec3f>& position)
{
    const auto valid = read_valid(file, description.conventions.channels.valid);
    const auto& background = description.conventions.background;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < position.pixel_count(); ++i) {
        const bool is_void = background && Vec3f{*background} == position[i];
        if ((!valid.empty() && valid[i] == 0) || is_void ||
            (valid.empty() && !is_finite(position[i]))) {
            position[i] = Vec3f{no_position};
            continue;
        }
        if (!is_finite(position[i])) {
            file.refuse_pixel(name, "P is not finite", i, "write valid = 0 where nothing is seen");
        }
        const Vec3f size = glm::abs(position[i]);
        if (std::max({size.x, size.y, size.z}) > static_cast<float>(scene::max_coordinate_m)) {
            file.refuse_pixel(name, "P is beyond 1e15", i, "write valid = 0 where nothing is seen");
        }
        ++judged;
    }
    if (judged == 0) {
        file.refuse("no pixel can be judged: valid is 0 or P not finite everywhere");
    }
}

/// Maps a mask value from [shadowed, lit] to [0, 1]; empty if it lies outside by more than 2 % of
/// the range, which rounding and filtering may cause.
std::optional<float> value_in_range(double value, const std::array<double, 2>& range)
{
    constexpr double slack = 0.02;
    const double share = (value - range[0]) / (range[1] - range[0]);
    return share >= -slack && share <= 1 + slack
               ? std::optional{static_cast<float>(std::clamp(share, 0.0, 1.0))}
               : std::nullopt;
}

/// The mask's value as a share of light.
/// @param name   of the mask's channel.
/// @param pixel  for messages.
float light_of(CaseImageFile& file, const std::string& name, float value, std::size_t pixel,
               const scene::ImageConventions& conventions)
{
    const auto& range = conventions.mask_range;
    if (conventions.lit_above) {
        return double{value} > *conventions.lit_above ? 1.0F : 0.0F;
    }
    if (range) {
        if (const auto light = value_in_range(double{value}, *range)) {
            return *light;
        }
        file.refuse_pixel(name, fmt::format("{} = {}", scene::one_line(name), value), pixel,
                          fmt::format("channels.mask_range = [{}, {}] leaves no room for it; give "
                                      "the values that mean shadowed and lit",
                                      range->front(), range->back()));
    }
    if (!(value >= 0 && value <= 1)) {
        file.refuse_pixel(name, fmt::format("{} = {}", scene::one_line(name), value), pixel,
                          "a mask is from 0 to 1; if this is light, set channels.lit_above, and if "
                          "other values mean shadowed and lit, channels.mask_range");
    }
    return value;
}

scene::Image<float> read_case_mask(CaseImageFile& file, const std::vector<std::string>& names,
                                   const scene::ImageConventions& conventions,
                                   const scene::Image<Vec3f>& position)
{
    const std::string name = file.find(names);
    if (name.empty()) {
        file.refuse(fmt::format("no channel {}: the mask is required; {}; channels.shadow gives it "
                                "another name; `gnomon capture-kit` writes what makes it",
                                scene::one_line(names.front()), file.listing()));
    }
    scene::Image<float> mask = file.numbers(name);
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (!is_finite(position[i])) {
            mask[i] = 0;
        } else if (std::isnan(mask[i])) {
            file.refuse_pixel(name, fmt::format("{} is NaN", scene::one_line(name)), i,
                              "a mask is 1 where lit, 0 where shadowed; write valid = 0 where "
                              "there is none");
        } else {
            mask[i] = light_of(file, name, mask[i], i, conventions);
        }
    }
    return mask;
}

constexpr std::string_view why_depths = "half would round depths away; write full floats";

/// A channel that a case may lack; empty then.
scene::Image<float> read_optional(CaseImageFile& file, const std::string& name)
{
    return name.empty() ? scene::Image<float>{} : file.exact_numbers(name, why_depths);
}

/// The map's depths; NaN where the lookup compared none.
scene::Image<float> read_map_depths(CaseImageFile& file, const std::string& name,
                                    const scene::Image<Vec3f>& position)
{
    scene::Image<float> depths = read_optional(file, name);
    for (std::size_t i = 0; i < depths.pixel_count(); ++i) {
        if (!std::isnan(position[i].x) && std::isfinite(depths[i]) &&
            !(depths[i] >= 0 && depths[i] <= 1)) {
            file.refuse_pixel(name, fmt::format("{} = {}", scene::one_line(name), depths[i]), i,
                              "a shadow map's depths are from 0 to 1; write NaN where none was "
                              "compared");
        }
    }
    return depths;
}

/// Depths of receivers. Some may lie outside [0, 1], beyond the near or far plane, but not most.
/// @param map_depths  NaN where the lookup compared none; may be empty.
scene::Image<float> read_receiver_depths(CaseImageFile& file, const std::string& name,
                                         const scene::Image<Vec3f>& position,
                                         const scene::Image<float>& map_depths)
{
    scene::Image<float> depths = read_optional(file, name);
    std::size_t compared = 0;
    std::size_t outside = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < depths.pixel_count(); ++i) {
        if (std::isnan(position[i].x) || !std::isfinite(depths[i]) ||
            (!map_depths.empty() && std::isnan(map_depths[i]))) {
            continue;
        }
        ++compared;
        if (!(depths[i] >= 0 && depths[i] <= 1)) {
            first = outside == 0 ? i : first;
            ++outside;
        }
    }
    if (outside * 2 > compared) {
        file.refuse_pixel(name, fmt::format("{} = {}", scene::one_line(name), depths[first]), first,
                          "most depths are not from 0 to 1; write what the lookup compares, not a "
                          "distance");
    }
    return depths;
}

/// Two numbers per pixel [texels]; empty if the file lacks them.
scene::Image<scene::Vec2f> read_texels(CaseImageFile& file, const std::string& name)
{
    if (file.find({name}, ".X").empty()) {
        return {};
    }
    const auto x = file.exact_numbers(name + ".X", why_depths);
    const auto y = file.exact_numbers(name + ".Y", why_depths);
    scene::Image<scene::Vec2f> texels{file.size()};
    for (std::size_t i = 0; i < texels.pixel_count(); ++i) {
        texels[i] = {x[i], y[i]};
    }
    return texels;
}

/// The index of the map that each judged pixel reads.
scene::MapIndices read_map_indices(CaseImageFile& file, const std::string& name,
                                   const scene::Image<Vec3f>& position)
{
    if (file.find({name}).empty()) {
        return {};
    }
    const scene::Image<std::uint32_t> numbers = file.whole_numbers(name, position);
    scene::MapIndices maps{file.size()};
    for (std::size_t i = 0; i < maps.pixel_count(); ++i) {
        if (std::isnan(position[i].x)) {
            continue;
        }
        if (numbers[i] >= scene::most_maps) {
            file.refuse_pixel(
                name, fmt::format("{} = {}", name, numbers[i]), i,
                fmt::format("a light has at most {} maps, counted from 0", scene::most_maps));
        }
        maps[i] = static_cast<std::uint8_t>(numbers[i]);
    }
    return maps;
}

scene::LookupLayers read_unmoved(CaseImageFile& file, const scene::Image<float>& tan_theta,
                                 const scene::Image<Vec3f>& position)
{
    if (file.find({"unmoved.V"}).empty()) {
        return {};
    }
    const auto r = file.exact_numbers("unmoved.z.light", why_depths);
    const auto d = file.exact_numbers("unmoved.z.map", why_depths);
    const auto verdict = file.numbers("unmoved.V");
    scene::LookupLayers unmoved{scene::Image<scene::LookupSample>{file.size()},
                                read_texels(file, "unmoved.texel"),
                                read_map_indices(file, "unmoved.map_index", position),
                                {},
                                read_texels(file, "unmoved.kernel_axis")};
    for (std::size_t i = 0; i < verdict.pixel_count(); ++i) {
        unmoved.samples[i] = {r[i], d[i], tan_theta.empty() ? 0.0F : tan_theta[i], verdict[i]};
    }
    return unmoved;
}

scene::LookupTerms read_terms(CaseImageFile& file)
{
    if (file.find({"moved"}, ".X").empty()) {
        return {};
    }
    constexpr std::string_view why = "half would round the effect of bias terms; write full floats";
    const auto x = file.exact_numbers("moved.X", why);
    const auto y = file.exact_numbers("moved.Y", why);
    const auto z = file.exact_numbers("moved.Z", why);
    const auto depth = file.exact_numbers("moved.depth", why);
    scene::LookupTerms terms{scene::Image<scene::Vec4f>{file.size()},
                             read_texels(file, "tap_gradient")};
    for (std::size_t i = 0; i < x.pixel_count(); ++i) {
        terms.moved[i] = {x[i], y[i], z[i], depth[i]};
    }
    return terms;
}

/// The maps below each other, each with its highest row first.
scene::Image<float> read_map(const scene::CaseImageSource& source, bool is_bottom_up,
                             std::uint64_t memory_bytes)
{
    CaseImageFile file{{&source, 1}, is_bottom_up, memory_bytes};
    if (file.size().height_px % file.size().width_px != 0) {
        file.refuse(
            fmt::format("the shadow map is {}x{} texels: it must be square, or squares below "
                        "each other, the first map on top",
                        file.size().width_px, file.size().height_px));
    }
    return file.exact_squares("map.d", why_depths);
}

} // namespace

CaseLayers read_case_layers(const scene::CaseFile& description, std::uint64_t memory_bytes)
{
    const scene::ImageConventions& conventions = description.conventions;
    CaseImageFile file{description.images, conventions.is_bottom_up, memory_bytes};
    const bool has_camera = description.says("camera.target");
    const scene::ChannelNames names = names_in(file, conventions.channels, has_camera);
    CaseLayers layers;
    layers.position =
        read_position(file, names.position, has_camera && !names_position(conventions.channels));
    layers.has_positions = !layers.position.empty();
    if (layers.has_positions) {
        mask_positions(file, file.find_vector(names.position)->front(), description,
                       layers.position);
    } else {
        layers.position = placeholder_positions(file, names);
    }
    layers.mask = read_case_mask(file, names.shadow, conventions, layers.position);
    if (const auto normal = file.find_vector(names.normal)) {
        const auto x = file.numbers((*normal)[0]);
        const auto y = file.numbers((*normal)[1]);
        const auto z = file.numbers((*normal)[2]);
        layers.normal = scene::Image<Vec3f>{file.size()};
        for (std::size_t i = 0; i < x.pixel_count(); ++i) {
            layers.normal[i] = {x[i], y[i], z[i]};
        }
    }
    if (const std::string object = file.find(names.object); !object.empty()) {
        layers.object_number = file.whole_numbers(object, layers.position);
    }
    layers.z_map = read_map_depths(file, file.find(names.z_map), layers.position);
    layers.z_light =
        read_receiver_depths(file, file.find(names.z_light), layers.position, layers.z_map);
    layers.texels = read_texels(file, "texel");
    layers.tan_theta = read_optional(file, file.find({"tan_theta"}));
    layers.maps = read_map_indices(file, "map_index", layers.position);
    layers.kernel_axes = read_texels(file, "kernel_axis");
    layers.unmoved = read_unmoved(file, layers.tan_theta, layers.position);
    if (layers.unmoved.kernel_axes.empty() && !layers.unmoved.samples.empty()) {
        layers.unmoved.kernel_axes =
            layers.kernel_axes; // a radius in texels does not depend on the bias
    }
    layers.terms = read_terms(file);
    if (description.map) {
        layers.map_depths = read_map(*description.map, conventions.is_bottom_up, memory_bytes);
    }
    return layers;
}

} // namespace gnomon::store
