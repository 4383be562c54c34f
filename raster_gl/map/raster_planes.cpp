#include "raster_gl/map/raster_planes.hpp"

#include "raster_gl/receivers.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace gnomon::raster_gl {

namespace {

using scene::Vec2d;

/// Window position [px] of the centre of a texel counted from the map's top left.
Vec2d centre_px(int resolution_texels, int x, int y)
{
    return {x + 0.5, resolution_texels - 1 - y + 0.5};
}

/// The tiles that a triangle may touch: first and last column and row.
struct TileSpan {
    std::size_t left = 0;
    std::size_t right = 0;
    std::size_t low = 0;
    std::size_t high = 0;

    [[nodiscard]] std::size_t count() const { return (right - left + 1) * (high - low + 1); }
};

TileSpan tiles_touched(const scene::RasterPlane& plane, double tile_px, double tiles_across)
{
    const auto& corners = plane.window().position_px;
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto tile = [&](double px) {
        return static_cast<std::size_t>(std::clamp(px / tile_px, 0.0, tiles_across - 1));
    };
    return {tile(left), tile(right), tile(low), tile(high)};
}

} // namespace

RasterPlanes::RasterPlanes(const Context& context, const scene::MeasuredPlanes& planes)
    : context_{context},
      planes_{planes},
      gpu_{context, planes.triangles},
      pass_{context},
      subpixel_bits_{context.facts().subpixel_bits}
{
    const auto clip = capture_clip_positions(context, gpu_, planes.frustum.light_clip_from_world);
    raster_.reserve(planes.triangles.triangles.size());
    for (const auto& [a, b, c] : planes.triangles.triangles) {
        const std::array corners{clip.at(a), clip.at(b), clip.at(c)};
        raster_.emplace_back(corners, planes.resolution_texels, planes.frustum.clip_range);
        if (traits_of(planes.frustum.content).measure == scene::Measure::ray) {
            const auto triangle = static_cast<std::uint32_t>(distances_.size());
            distances_.emplace_back(planes.triangles.corners(triangle), corners,
                                    raster_.back().window(), planes.frustum);
        }
    }
}

const ShadowMap& RasterPlanes::draw(scene::DepthFormat format)
{
    scene::ShadowMapSettings settings;
    settings.resolution_texels = planes_.resolution_texels;
    settings.depth_format = format;
    return pass_.render(gpu_, {&planes_.frustum, 1}, settings);
}

bool RasterPlanes::surely_covers(const scene::RasterPlane& plane, const Vec2d& at) const
{
    // Corners snap to the sub-pixel grid, so edges move by less than one sub-pixel.
    return plane.is_whole() && plane.inside_px(at) > std::ldexp(1.0, -subpixel_bits_);
}

std::vector<bool> RasterPlanes::disputed_samples() const
{
    const auto across = static_cast<std::size_t>(planes_.resolution_texels / planes_.tile_texels);
    const double subpixel_px = std::ldexp(1.0, -subpixel_bits_);
    std::vector<bool> disputed(raster_.size());
    std::size_t visits = 0;
    for (std::size_t i = 0; i < raster_.size(); ++i) {
        const TileSpan span =
            tiles_touched(raster_[i], planes_.tile_texels, static_cast<double>(across));
        constexpr std::size_t bearable_tiles = 64; // on average
        visits += span.count();
        if (visits > bearable_tiles * raster_.size()) {
            throw scene::InputError("offset: this far from the origin float32 rounding moves the "
                                    "measured planes over each other; lower it");
        }
        for (std::size_t row = span.low; row <= span.high; ++row) {
            for (std::size_t column = span.left; column <= span.right; ++column) {
                const std::size_t sample = row * across + column;
                if (sample == i || sample >= raster_.size()) {
                    continue;
                }
                const auto [x, y] = planes_.texel(sample);
                const Vec2d at = centre_px(planes_.resolution_texels, x, y);
                disputed[sample] = disputed[sample] || raster_[i].inside_px(at) > -subpixel_px;
            }
        }
    }
    return disputed;
}

scene::DepthMeasurement RasterPlanes::measure(scene::DepthFormat format)
{
    const ShadowMap& map = draw(format);
    const auto codes = read_codes(context_, map);
    const bool has_z = traits_of(format).conversion == scene::Conversion::shader;
    const auto z = has_z ? read_unquantised_z(context_, map) : scene::Image<float>{};
    scene::DepthMeasurement measurement;
    measurement.format = format;
    measurement.samples.reserve(raster_.size());
    const std::vector<bool> disputed = disputed_samples();
    for (std::size_t i = 0; i < raster_.size(); ++i) {
        const auto [x, y] = planes_.texel(i);
        const Vec2d at = centre_px(planes_.resolution_texels, x, y);
        if (disputed[i] || !surely_covers(raster_[i], at)) {
            ++measurement.missing;
            continue;
        }
        scene::DepthSample sample{planes_.light_distance_m(i), texel_depth(i, at, codes(x, y))};
        if (has_z) {
            sample.shader_depth = z(x, y);
        }
        measurement.samples.push_back(sample);
    }
    // Rounding the vertices can swap planes less than a float32 step apart.
    std::ranges::stable_sort(measurement.samples, {}, &scene::DepthSample::light_distance_m);
    return measurement;
}

std::vector<scene::TexelDepth> RasterPlanes::read_all(scene::DepthFormat format)
{
    const auto codes = read_codes(context_, draw(format));
    std::vector<scene::TexelDepth> texels;
    for (std::size_t i = 0; i < raster_.size(); ++i) {
        if (raster_[i].is_whole()) {
            include_triangle(i, codes, texels);
        }
    }
    return texels;
}

scene::TexelDepth RasterPlanes::texel_depth(std::size_t triangle, const Vec2d& at,
                                            std::uint32_t code) const
{
    if (!distances_.empty()) {
        const scene::RasterDistance& distance = distances_[triangle];
        return {distance.over_far(at), distance.driver_bound(at, subpixel_bits_), code};
    }
    const scene::RasterPlane& plane = raster_[triangle];
    return {plane.depth(at), plane.driver_bound(at, subpixel_bits_), code};
}

void RasterPlanes::include_triangle(std::size_t triangle, const scene::Image<std::uint32_t>& codes,
                                    std::vector<scene::TexelDepth>& texels) const
{
    const scene::RasterPlane& plane = raster_[triangle];
    const int last = planes_.resolution_texels - 1;
    const auto& corners = plane.window().position_px;
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto clamped = [&](double px) {
        return static_cast<int>(std::clamp(px, 0.0, static_cast<double>(last)));
    };
    for (int row = clamped(low), top = clamped(high); row <= top; ++row) {
        for (int x = clamped(left), end = clamped(right); x <= end; ++x) {
            const int y = last - row;
            const Vec2d at = centre_px(planes_.resolution_texels, x, y);
            if (surely_covers(plane, at)) {
                texels.push_back(texel_depth(triangle, at, codes(x, y)));
            }
        }
    }
}

namespace {

double stored_depth(std::uint32_t code, scene::DepthFormat format)
{
    return format.is_float() ? double{std::bit_cast<float>(code)}
                             : code / (std::ldexp(1.0, format.bits) - 1);
}

/// Flat planes at depths from 0 to 1.
scene::MeasuredPlanes flat_planes()
{
    scene::MeasuredPlaneSettings settings;
    settings.range = {scene::Projection::orthographic, 1, 3, false, {}};
    settings.count = 8;
    settings.smallest_map_texels = 64;
    return scene::make_measured_planes(settings);
}

std::vector<double> stored_depths(RasterPlanes& planes, scene::DepthFormat format)
{
    std::vector<double> depths;
    for (const scene::DepthSample& sample : planes.measure(format).samples) {
        depths.push_back(stored_depth(sample.texel.code, format));
    }
    return depths;
}

} // namespace

std::vector<scene::OffsetUnit> measure_offset_units(const Context& context,
                                                    scene::DepthFormat format)
{
    const scene::MeasuredPlanes planes = flat_planes();
    RasterPlanes raster{context, planes};
    const std::vector<double> still = stored_depths(raster, format);
    const std::size_t middle = still.size() / 2;
    std::vector<double> shifted = still;
    float units = 1;
    // Enough units that the shift dwarfs the format's rounding.
    constexpr double wanted_shift = 1.0 / 64;
    constexpr float most_units = 0x1p30F;
    while (shifted[middle] - still[middle] < wanted_shift && units < most_units) {
        units *= 2;
        const PolygonOffsetScope offset{methods::PolygonOffset{0, units, 0}};
        shifted = stored_depths(raster, format);
    }
    std::vector<scene::OffsetUnit> result;
    for (std::size_t i = 1; i + 1 < still.size(); ++i) { // the end planes touch near and far
        result.push_back({still[i], (shifted[i] - still[i]) / double{units}});
    }
    return result;
}

} // namespace gnomon::raster_gl
