#include "api/depth_study.hpp"

#include "analysis/depth/depth_error.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/raster_planes.hpp"
#include "scene/error.hpp"
#include "scene/settings/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gnomon::api {

namespace {

using analysis::DepthCoding;
using analysis::DepthMapping;
using analysis::DepthStudy;

/// Why the driver lacks the format; "" if it supports it.
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
                "offset = {:.7g}: float32 rounding moves every plane off its place or out "
                "of near and far; lower it",
                settings.offset_m));
        }
        study.measured = analysis::measured_depth_error(study.mapping, measurement);
    }
    return studies;
}

namespace {

using analysis::DepthErrorRow;
using analysis::DepthStudy;

constexpr double default_near_m = 4;
constexpr double default_far_m = 50;
// Finer than the spacing of doubles at 1 m.
constexpr double smallest_tolerance_m = 1e-15;

void require_range(const DepthRequest& request, double near_m, double far_m)
{
    constexpr double smallest_near_share = 1e-12;
    if (!(near_m < far_m) || !(std::abs(near_m) <= scene::max_coordinate_m) ||
        !(far_m <= scene::max_coordinate_m)) {
        throw scene::InputError(
            fmt::format("near = {}, far = {}: near must be below far, both within ±{:g} m", near_m,
                        far_m, scene::max_coordinate_m));
    }
    if (request.projection == scene::Projection::perspective &&
        !(near_m >= smallest_near_share * far_m)) {
        throw scene::InputError(
            fmt::format("near = {}: must be at least {:g} of far for a perspective projection",
                        near_m, smallest_near_share));
    }
}

void require_placement(const DepthRequest& request)
{
    if (request.samples < 2 || request.samples > scene::most_measured_planes) {
        throw scene::InputError(fmt::format("samples = {}: must be 2 to {}", request.samples,
                                            scene::most_measured_planes));
    }
    if (!(request.tilt_deg >= 0 && request.tilt_deg <= scene::largest_plane_tilt_deg)) {
        throw scene::InputError(fmt::format("tilt = {} deg: must be 0 to {}", request.tilt_deg,
                                            scene::largest_plane_tilt_deg));
    }
    if (!(std::abs(request.offset_m) <= scene::max_coordinate_m)) {
        throw scene::InputError(fmt::format("offset = {}: must be within ±{:g} m", request.offset_m,
                                            scene::max_coordinate_m));
    }
}

void require_tolerance(const DepthRequest& request)
{
    if (request.tolerance_m && !(*request.tolerance_m >= smallest_tolerance_m &&
                                 *request.tolerance_m <= scene::max_coordinate_m)) {
        throw scene::InputError(fmt::format("tolerance = {}: must be {:g} to {:g} m",
                                            *request.tolerance_m, smallest_tolerance_m,
                                            scene::max_coordinate_m));
    }
}

void require_content(const DepthRequest& request)
{
    if (!request.is_gl_depth() && (request.reversed || request.clip_range ||
                                   request.projection != scene::Projection::perspective)) {
        throw scene::InputError(fmt::format("content = \"{}\" is a distance from a positional "
                                            "light, not a projection's depth: leave out "
                                            "reversed, clip and projection",
                                            traits_of(request.content).name));
    }
}

scene::MeasuredPlaneSettings planes_of(const DepthRequest& request)
{
    require_content(request);
    require_tolerance(request);
    const double near_m = request.near_m.value_or(default_near_m);
    const double far_m = request.far_m.value_or(default_far_m);
    require_range(request, near_m, far_m);
    require_placement(request);
    scene::MeasuredPlaneSettings planes;
    planes.range = {request.projection, near_m, far_m, request.reversed,
                    request.clip_range.value_or(request.reversed
                                                    ? scene::ClipRange::zero_to_one
                                                    : scene::ClipRange::minus_one_to_one)};
    planes.content = request.content;
    if (!request.is_gl_depth()) {
        planes.range.far_m = double{static_cast<float>(far_m)}; // GL divides by the float32 value
        require_range(request, near_m, planes.range.far_m);
    }
    planes.count = request.samples;
    planes.tilt_rad = request.tilt_deg * std::numbers::pi / 180;
    // The camera's position is a float32.
    planes.offset_m = double{static_cast<float>(request.offset_m)};
    return planes;
}

std::vector<DepthErrorRow> rows_of(const DepthStudy& study, std::size_t samples)
{
    if (study.measured) {
        return study.measured->rows;
    }
    return study.tolerance
               ? analysis::tolerance_rows(study.mapping, study.coding, samples, *study.tolerance)
               : analysis::formula_rows(study.mapping, study.coding, samples);
}

std::vector<DepthStudy> studied(const std::vector<DepthChoice>& choices,
                                const scene::MeasuredPlaneSettings& planes,
                                const raster_gl::Context* context,
                                const std::string& why_not_measured)
{
    if (context != nullptr) {
        return study_formats(*context, choices, planes);
    }
    std::vector<DepthStudy> studies;
    for (const DepthChoice& choice : choices) {
        studies.push_back(study_theory(choice, planes, why_not_measured));
    }
    return studies;
}

} // namespace

void require_sound(const DepthRequest& request)
{
    (void)planes_of(request);
}

StudiedDepth study_depth(const DepthRequest& request, const DepthChoice& choice,
                         const raster_gl::Context* context, const std::string& why_not_measured)
{
    const scene::MeasuredPlaneSettings planes = planes_of(request);
    StudiedDepth found{studied({choice}, planes, context, why_not_measured).front(), {}, {}};
    if (context != nullptr) {
        if (!found.study.measured && choice.is_named) {
            throw scene::InputError(fmt::format("format = \"{}\": {}; choose another, or ask for "
                                                "the theory only",
                                                choice.name, found.study.not_measured_because));
        }
        found.driver = {context->facts().renderer, context->facts().version};
    }
    if (request.tolerance_m) {
        found.study.tolerance = analysis::constant_tolerance(
            found.study.mapping, found.study.coding, *request.tolerance_m);
    }
    found.rows = rows_of(found.study, static_cast<std::size_t>(request.samples));
    return found;
}

std::vector<DepthStudy> study_all_formats(const DepthRequest& request,
                                          const raster_gl::Context* context,
                                          const std::string& why_not_measured)
{
    std::vector<DepthChoice> all;
    for (const scene::DepthFormat format : scene::depth_formats()) {
        all.push_back(choose_format(scene::depth_format_name(format), {}));
    }
    std::vector<DepthStudy> studies = studied(all, planes_of(request), context, why_not_measured);
    if (!request.reversed && request.is_gl_depth()) {
        DepthRequest turned = request;
        turned.reversed = true;
        turned.clip_range = scene::ClipRange::zero_to_one;
        const auto reversed =
            studied({choose_format("d32f", {})}, planes_of(turned), context, why_not_measured);
        const auto floats = std::ranges::find(studies, "d32f", &DepthStudy::format);
        studies.insert(floats + 1, reversed.front());
    }
    return studies;
}

analysis::PlanTarget plan_target(const DepthRequest& request, double max_error_m)
{
    if (!(max_error_m > 0) || !std::isfinite(max_error_m)) {
        throw scene::InputError(fmt::format("max_error_m = {}: must be above 0", max_error_m));
    }
    const double far_m = request.far_m.value_or(default_far_m);
    require_range(request, request.near_m.value_or(0.5 * far_m), far_m);
    return {request.projection, max_error_m, far_m, request.near_m};
}

std::vector<std::string> studied_contents()
{
    std::vector<std::string> names;
    for (const scene::MapContentTraits& content : scene::map_contents()) {
        if (content.measure != scene::Measure::axis) {
            names.emplace_back(content.name);
        }
    }
    return names;
}

} // namespace gnomon::api
