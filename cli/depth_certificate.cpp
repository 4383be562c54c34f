#include "cli/depth_certificate.hpp"

#include "analysis/depth/texel_class.hpp"
#include "raster_gl/depth_formats.hpp"
#include "raster_gl/polygon_offset.hpp"
#include "raster_gl/raster_planes.hpp"
#include "scene/depth_planes.hpp"

#include <numbers>

namespace gnomon::cli {

namespace {

constexpr int map_texels = 512;

scene::DepthPlanes tilted_planes(int count, double tilt_deg)
{
    scene::DepthPlaneSettings settings;
    settings.range = {scene::Projection::perspective, 4, 50, false, {}};
    settings.count = count;
    settings.tilt_rad = tilt_deg * std::numbers::pi / 180;
    settings.smallest_map_texels = map_texels;
    return scene::make_depth_planes(settings);
}

/// Planes, and what draws them: one after the other refers to the planes.
struct Drawn {
    scene::DepthPlanes planes;
    raster_gl::RasterPlanes raster;

    Drawn(const raster_gl::Context& context, int count, double tilt_deg)
        : planes{tilted_planes(count, tilt_deg)},
          raster{context, planes}
    {
    }
};

/// GL's own formats as far as the driver has them, and three of the shader's.
std::vector<scene::DepthFormat> certified_formats(const raster_gl::Context& context)
{
    std::vector<scene::DepthFormat> formats;
    for (const auto& support : raster_gl::query_depth_formats(context)) {
        const auto format = scene::depth_format_from_name(support.name);
        if (support.supported && format) {
            formats.push_back(*format);
        }
    }
    for (const int bits : {8, 16, 24}) {
        formats.push_back({scene::DepthFormat::Kind::unorm, bits});
    }
    return formats;
}

} // namespace

std::vector<reports::CertifiedFormat> certify_driver_depth(const raster_gl::Context& context)
{
    Drawn steep{context, 1, 80};         // one triangle over most of the map and of the range
    Drawn large{context, 16, 45};        // 128 texels wide
    Drawn small{context, 128 * 128, 45}; // 3 texels wide, most of them far from the map's origin
    std::vector<reports::CertifiedFormat> certified;
    for (const scene::DepthFormat format : certified_formats(context)) {
        const auto coding = analysis::DepthCoding::of(format);
        auto texels = steep.raster.read_all(format);
        const auto more = large.raster.read_all(format);
        texels.insert(texels.end(), more.begin(), more.end());
        reports::CertifiedFormat& result = certified.emplace_back();
        result.name = scene::depth_format_name(format);
        result.large = analysis::certify_texels(coding, texels);
        result.small = analysis::certify_texels(coding, small.raster.read_all(format));
        if (format.kind != scene::DepthFormat::Kind::unorm) {
            for (const auto& [depth, r] : raster_gl::measure_offset_units(context, format)) {
                result.offset_units.push_back({depth, r});
            }
        }
    }
    return certified;
}

} // namespace gnomon::cli
