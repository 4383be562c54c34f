#include "raster_gl/polygon_offset.hpp"

#include "raster_gl/caster_state.hpp"
#include "raster_gl/raster_planes.hpp"

#include <bit>
#include <cmath>

namespace gnomon::raster_gl {

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
    // Enough units to make the format's rounding small beside the shift.
    constexpr double wanted_shift = 1.0 / 64;
    constexpr float most_units = 0x1p30F;
    while (shifted[middle] - still[middle] < wanted_shift && units < most_units) {
        units *= 2;
        const OffsetDraws offset{methods::PolygonOffset{0, units, 0}};
        shifted = stored_depths(raster, format);
    }
    std::vector<scene::OffsetUnit> result;
    for (std::size_t i = 1; i + 1 < still.size(); ++i) { // the ends meet near and far
        result.push_back({still[i], (shifted[i] - still[i]) / double{units}});
    }
    return result;
}

} // namespace gnomon::raster_gl
