#include "cli/program/depth_certificate.hpp"

#include "analysis/depth/texel_class.hpp"
#include "raster_gl/depth_formats.hpp"
#include "raster_gl/polygon_offset.hpp"
#include "raster_gl/raster_planes.hpp"
#include "scene/depth/measured_planes.hpp"

#include <array>
#include <numbers>
#include <vector>

namespace gnomon::cli {

namespace {

constexpr int map_texels = 512;

std::array<scene::DepthRange, 4> certified_ranges()
{
    using scene::ClipRange;
    constexpr auto perspective = scene::Projection::perspective;
    return {{{perspective, 4, 50, false, ClipRange::minus_one_to_one},
             {perspective, 4, 50, false, ClipRange::zero_to_one},
             {perspective, 4, 50, true, ClipRange::zero_to_one},
             {perspective, 0.1, 1000, true, ClipRange::zero_to_one}}};
}

scene::MeasuredPlanes tilted_planes(const scene::DepthRange& range, int count, double tilt_deg)
{
    scene::MeasuredPlaneSettings settings;
    settings.range = range;
    settings.count = count;
    settings.tilt_rad = tilt_deg * std::numbers::pi / 180;
    settings.smallest_map_texels = map_texels;
    return scene::make_measured_planes(settings);
}

/// Planes, and what draws them: one after the other refers to the planes.
struct Drawn {
    scene::MeasuredPlanes planes;
    raster_gl::RasterPlanes raster;

    Drawn(const raster_gl::Context& context, const scene::DepthRange& range, int count,
          double tilt_deg)
        : planes{tilted_planes(range, count, tilt_deg)},
          raster{context, planes}
    {
    }
};

/// GL's own formats as far as the driver has them, and some of the shader's.
std::vector<scene::DepthFormat> certified_formats(const raster_gl::Context& context)
{
    std::vector<scene::DepthFormat> formats;
    for (const auto& support : raster_gl::query_depth_formats(context)) {
        const auto format = scene::depth_format_from_name(support.name);
        if (support.supported && format) {
            formats.push_back(*format);
        }
    }
    for (const char* name : {"r16f", "rgba8", "u8", "u16", "u24"}) {
        formats.push_back(scene::depth_format_from_name(name).value());
    }
    return formats;
}

reports::CertifiedRange certify_range(const raster_gl::Context& context,
                                      const scene::DepthRange& range,
                                      const std::vector<scene::DepthFormat>& formats)
{
    Drawn steep{context, range, 1, 80};         // one triangle over most of the map and the range
    Drawn large{context, range, 16, 45};        // 128 texels wide
    Drawn small{context, range, 128 * 128, 45}; // 3 texels wide, most far from the map's origin
    reports::CertifiedRange certified{range, {}};
    for (const scene::DepthFormat format : formats) {
        const auto coding = analysis::DepthCoding::of(format);
        auto texels = steep.raster.read_all(format);
        const auto more = large.raster.read_all(format);
        texels.insert(texels.end(), more.begin(), more.end());
        certified.formats.push_back(
            {scene::depth_format_name(format), analysis::certify_texels(coding, texels),
             analysis::certify_texels(coding, small.raster.read_all(format))});
    }
    return certified;
}

reports::FormatOffsetUnits offset_units(const raster_gl::Context& context,
                                        scene::DepthFormat format)
{
    return {scene::depth_format_name(format), raster_gl::measure_offset_units(context, format)};
}

} // namespace

reports::DriverCertificate certify_driver_depth(const raster_gl::Context& context)
{
    const std::vector<scene::DepthFormat> formats = certified_formats(context);
    reports::DriverCertificate certificate;
    for (const scene::DepthRange& range : certified_ranges()) {
        certificate.ranges.push_back(certify_range(context, range, formats));
    }
    for (const scene::DepthFormat format : formats) {
        if (traits_of(format).conversion == scene::Conversion::gl) {
            certificate.offset_units.push_back(offset_units(context, format));
        }
    }
    return certificate;
}

} // namespace gnomon::cli
