#include "analysis/bias/drawn_offset.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

/// Inputs of the offset at one pixel.
struct OffsetPlace {
    const scene::LightFrustum* map = nullptr; ///< the map that the pixel reads
    double light_distance_m = 0;
    double depth = 0;   ///< of the receiver
    double m = 0;       ///< largest change of the depth per texel
    double r = 0;       ///< depth units
    double texel_m = 0; ///< width of a texel at the receiver
};

/// By how much the offset moves each pixel's surface; NaN where it is not scored.
class OffsetImages {
public:
    explicit OffsetImages(std::size_t pixels)
        : depth_(pixels, std::numeric_limits<float>::quiet_NaN()),
          metres_(depth_),
          texels_(depth_)
    {
    }

    void set(std::size_t pixel, const OffsetPlace& place, const methods::PolygonOffset& offset)
    {
        const double moved = moved_depth(place, offset);
        const double length_m = bias_length_m(*place.map, -moved, place.light_distance_m);
        depth_[pixel] = static_cast<float>(moved);
        metres_[pixel] = static_cast<float>(-length_m);
        texels_[pixel] = static_cast<float>(-length_m / place.texel_m);
    }

    [[nodiscard]] std::optional<OffsetLengths> lengths()
    {
        const auto of_depth = find_quantiles(depth_);
        const auto of_metres = find_quantiles(metres_);
        const auto of_texels = find_quantiles(texels_);
        return of_depth && of_metres && of_texels
                   ? std::optional{OffsetLengths{*of_depth, *of_metres, *of_texels}}
                   : std::nullopt;
    }

private:
    /// How much deeper the surface lies in the map, which holds depths in [0, 1]; in a reversed
    /// map, how much less deep.
    static double moved_depth(const OffsetPlace& place, const methods::PolygonOffset& offset)
    {
        // A factor of 0 contributes nothing, however steep the surface.
        const double of_factor = offset.factor == 0 ? 0 : double{offset.factor} * place.m;
        const double o =
            std::clamp(place.depth + limited_sum(offset, of_factor, place.r), 0.0, 1.0) -
            place.depth;
        return place.map->reversed ? -o : o;
    }

    std::vector<float> depth_;
    std::vector<float> metres_;
    std::vector<float> texels_;
};

OffsetPlace offset_place(std::size_t pixel, const DrawnOffsetInputs& inputs)
{
    OffsetPlace place;
    place.map = &inputs.maps.map_of(pixel);
    place.light_distance_m = double{inputs.light_distance_m[pixel]};
    place.depth =
        std::clamp(DepthMapping{place.map->stored_range()}.depth(place.light_distance_m), 0.0, 1.0);
    place.m = largest_slope(*place.map, inputs.triangles.corners(inputs.receivers[pixel]),
                            inputs.maps.resolution_texels);
    place.r = offset_unit_at(inputs.units, inputs.depth_format, place.depth);
    place.texel_m = place.map->texel_width_m(place.light_distance_m, inputs.maps.resolution_texels);
    return place;
}

} // namespace

scene::Vec2d depth_gradient(const scene::LightFrustum& map,
                            const std::array<scene::Vec3f, 3>& corners, int resolution_texels)
{
    const scene::Vec3d a{corners[0]};
    const scene::Vec3d normal =
        glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
    const scene::Vec4d plane{normal, -glm::dot(normal, a)};
    const scene::Vec4d in_clip_space =
        glm::transpose(glm::inverse(scene::Mat4d{map.light_clip_from_world})) * plane;
    const double depth_per_ndc = map.clip_range == scene::ClipRange::zero_to_one ? 1.0 : 0.5;
    const double scale = -2.0 * depth_per_ndc / (resolution_texels * in_clip_space.z);
    return {in_clip_space.x * scale, in_clip_space.y * scale};
}

double largest_slope(const scene::LightFrustum& map, const std::array<scene::Vec3f, 3>& corners,
                     int resolution_texels)
{
    const scene::Vec2d gradient = depth_gradient(map, corners, resolution_texels);
    return std::max(std::abs(gradient.x), std::abs(gradient.y));
}

double offset_unit_at(std::span<const scene::OffsetUnit> units, scene::DepthFormat format,
                      double depth)
{
    const scene::OffsetUnit& nearest = *std::ranges::min_element(
        units, {}, [depth](const scene::OffsetUnit& unit) { return std::abs(unit.depth - depth); });
    return nearest.r * depth_step(format, static_cast<float>(depth)) /
           depth_step(format, static_cast<float>(nearest.depth));
}

double limited_sum(const methods::PolygonOffset& offset, double of_factor, double r)
{
    const double limit{offset.clamp};
    const double sum = of_factor + double{offset.units} * r;
    if (limit > 0) {
        return std::min(sum, limit);
    }
    return limit < 0 ? std::max(sum, limit) : sum;
}

std::optional<DrawnOffset> find_drawn_offset(const methods::PolygonOffset& offset,
                                             const DrawnOffsetInputs& inputs)
{
    if (inputs.units.empty()) {
        throw std::invalid_argument("find_drawn_offset: inputs: no unit was measured");
    }
    const std::size_t pixels = inputs.classes.pixel_count();
    OffsetImages of_factor{pixels};
    OffsetImages of_units{pixels};
    OffsetImages whole{pixels};
    std::vector<float> r(pixels, std::numeric_limits<float>::quiet_NaN());
    for_each_run(pixels, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (scene::is_scored(inputs.classes[i])) {
                const OffsetPlace place = offset_place(i, inputs);
                r[i] = static_cast<float>(place.r);
                of_factor.set(i, place, {offset.factor, 0, offset.clamp});
                of_units.set(i, place, {0, offset.units, offset.clamp});
                whole.set(i, place, offset);
            }
        }
    });
    const auto units_there = find_quantiles(r);
    const auto factor_lengths = of_factor.lengths();
    const auto units_lengths = of_units.lengths();
    const auto lengths = whole.lengths();
    if (!units_there || !factor_lengths || !units_lengths || !lengths) {
        return std::nullopt;
    }
    return DrawnOffset{offset, *units_there, *factor_lengths, *units_lengths, *lengths};
}

} // namespace gnomon::analysis
