#include "api/depth/depth_measure.hpp"

#include "raster_gl/depth_formats.hpp"
#include "raster_gl/raster_planes.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::api {

namespace {

using analysis::DepthCoding;
using analysis::DepthMapping;
using analysis::DepthStudy;

/// Why the driver has no such format; "" if it has.
std::string lack_of(const std::vector<raster_gl::FormatSupport>& formats, const std::string& name)
{
    const auto found = std::ranges::find(formats, name, &raster_gl::FormatSupport::name);
    return found == formats.end() || found->supported
               ? std::string{}
               : fmt::format("this driver has no {}: it stores {}", name, found->instead);
}

} // namespace

DepthChoice choose_format(const std::string& format, std::optional<int> bits)
{
    if (!format.empty()) {
        const auto known = scene::depth_format_from_name(format);
        if (!known) {
            throw scene::InputError(fmt::format("format = \"{}\": no such format; use one of {}",
                                                format, scene::depth_format_listing()));
        }
        return {DepthCoding::of(*known), known, format, true};
    }
    const int width = bits.value_or(24);
    if (width < 8 || width > 32) {
        throw scene::InputError(fmt::format("bits = {}: must be 8 to 32", width));
    }
    for (const char prefix : {'d', 'u'}) {
        const std::string name = fmt::format("{}{}", prefix, width);
        if (const auto known = scene::depth_format_from_name(name)) {
            return {DepthCoding::unorm(width), known, name};
        }
    }
    return {DepthCoding::unorm(width), {}, fmt::format("{}-bit unorm", width)};
}

DepthStudy study_theory(const DepthChoice& choice, const scene::MeasuredPlaneSettings& planes,
                        const std::string& not_measured_because)
{
    const DepthMapping mapping{planes.content, planes.range};
    return {mapping,
            choice.coding,
            choice.name,
            planes.tilt_rad,
            planes.offset_m,
            analysis::depth_theory(mapping, choice.coding, planes.offset_m),
            {},
            not_measured_because};
}

std::vector<DepthStudy> study_formats(const raster_gl::Context& context,
                                      const std::vector<DepthChoice>& choices,
                                      const scene::MeasuredPlaneSettings& settings)
{
    const auto formats = raster_gl::query_depth_formats(context);
    const scene::MeasuredPlanes planes = scene::make_measured_planes(settings);
    raster_gl::RasterPlanes raster{context, planes};
    std::vector<DepthStudy> studies;
    for (const DepthChoice& choice : choices) {
        DepthStudy& study =
            studies.emplace_back(study_theory(choice, settings, lack_of(formats, choice.name)));
        if (!choice.format || !study.not_measured_because.empty()) {
            continue;
        }
        const scene::DepthMeasurement measurement = raster.measure(*choice.format);
        if (measurement.samples.empty()) {
            throw scene::InputError(fmt::format(
                "offset = {:.7g}: float32 moves every plane off its place or out of near "
                "and far; lower it",
                settings.offset_m));
        }
        study.measured = analysis::measured_depth_error(study.mapping, measurement);
    }
    return studies;
}

} // namespace gnomon::api
