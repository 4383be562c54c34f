#include "cli/commands.hpp"

#include "analysis/depth/measured_error.hpp"
#include "api/memory.hpp"
#include "cli/system/process.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/raster_planes.hpp"
#include "reference_rt/truth.hpp"
#include "reports/depth/depth_certificate_report.hpp"
#include "reports/pictures/canvas.hpp"
#include "scene/depth/measured_planes.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
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

/// `raster` refers to `planes`.
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

/// GL's formats that the driver supports, and some that the shader writes.
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

/// Classifies every texel that large and small triangles surely cover, in each of the driver's
/// formats and in u8, u16 and u24, and measures the unit of glPolygonOffset.
///
/// Near 4 to far 50 in the clip ranges [-1, 1] and [0, 1] and reversed, and near 0.1 to far 1000
/// reversed, where most depths are small, and so is the driver's bound.
/// @throws scene::EnvironmentError  if GL fails.
/// Source: docs/depth_precision.md#certificate.
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

using Json = nlohmann::ordered_json;

/// Facts about this machine; `problems` says what is missing and how to get it.
struct Findings {
    std::vector<raster_gl::DeviceInfo> devices;
    std::optional<raster_gl::GlFacts> gl;
    std::vector<raster_gl::FormatSupport> formats;
    reports::DriverCertificate certificate; ///< empty without --depth
    std::string embree;
    std::uint64_t available_memory_bytes = 0;
    unsigned cores = 0;
    std::vector<std::string> problems;
};

void look_at_gl(Findings& findings, std::optional<int> device, bool certifies_depth)
{
    try {
        findings.devices = raster_gl::list_devices();
        const raster_gl::Context context{device};
        findings.gl = context.facts();
        findings.formats = raster_gl::query_depth_formats(context);
        if (certifies_depth) {
            findings.certificate = certify_driver_depth(context);
        }
    } catch (const scene::EnvironmentError& error) {
        findings.problems.emplace_back(error.what());
    }
}

Findings look(std::optional<int> device, bool certifies_depth)
{
    Findings findings;
    look_at_gl(findings, device, certifies_depth);
    findings.embree = reference_rt::embree_version();
    findings.available_memory_bytes = api::available_memory_bytes();
    findings.cores = std::thread::hardware_concurrency();
    if (!std::filesystem::is_directory(reports::default_font_folder)) {
        findings.problems.emplace_back(
            "no DejaVu fonts: --picture cannot label its panels; install them (Debian: apt-get "
            "install fonts-dejavu-core)");
    }
    return findings;
}

Json findings_json(const Findings& findings)
{
    Json json;
    json["gnomon"] = GNOMON_VERSION;
    json["devices"] = Json::array();
    for (const auto& device : findings.devices) {
        json["devices"].push_back({{"index", device.index}, {"description", device.description}});
    }
    json["gl"] = nullptr;
    if (findings.gl) {
        const raster_gl::GlFacts& gl = *findings.gl;
        json["gl"] = {{"renderer", gl.renderer},
                      {"version", gl.version},
                      {"vendor", gl.vendor},
                      {"platform", gl.platform},
                      {"max_texture_texels", gl.max_texture_texels},
                      {"max_viewport_px", gl.max_viewport_px},
                      {"subpixel_bits", gl.subpixel_bits}};
    }
    json["depth_formats"] = Json::object();
    for (const auto& format : findings.formats) {
        json["depth_formats"][format.name] = format.supported;
    }
    if (!findings.certificate.ranges.empty()) {
        json["depth_certificate"] = reports::driver_certificate_json(findings.certificate);
    }
    json["embree"] = findings.embree;
    json["cores"] = findings.cores;
    json["available_memory_bytes"] = findings.available_memory_bytes;
    json["problems"] = findings.problems;
    return json;
}

std::string row(std::string_view name, std::string_view value)
{
    return fmt::format("{:<16}{}\n", name, value);
}

std::string to_text(const Findings& findings)
{
    std::string text = row("gnomon", GNOMON_VERSION);
    for (const auto& device : findings.devices) {
        text += row(fmt::format("EGL device {}", device.index), device.description);
    }
    if (findings.gl) {
        const raster_gl::GlFacts& gl = *findings.gl;
        text += row("GL renderer", gl.renderer) + row("GL version", gl.version) +
                row("GL vendor", gl.vendor) + row("GL platform", gl.platform) +
                row("largest map", fmt::format("{} texels a side", gl.max_texture_texels)) +
                row("subpixel bits", fmt::format("{}", gl.subpixel_bits));
    }
    for (const auto& format : findings.formats) {
        text +=
            row("format " + format.name, format.supported ? "yes" : "no, gives " + format.instead);
    }
    if (findings.gl) {
        text += row("formats u8…u24", "yes, written by the shader");
    }
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const double available_gib = static_cast<double>(findings.available_memory_bytes) / gibibyte;
    text += row("Embree", findings.embree) + row("cores", fmt::format("{}", findings.cores)) +
            row("free memory", fmt::format("{:.1f} GiB", available_gib));
    for (const std::string& problem : findings.problems) {
        text += row("missing", problem);
    }
    if (!findings.certificate.ranges.empty()) {
        text += reports::certificate_text(findings.certificate) + "\n";
    }
    return text + (findings.problems.empty() ? "Everything that Gnomon needs is here.\n" : "");
}

} // namespace

void add_doctor_command(CLI::App& program)
{
    struct Options {
        bool json = false;
        bool depth = false;
        std::optional<int> device;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "doctor", "Say what GL, Embree and drivers are here, what is missing, and how to get it");
    command->add_flag("--json", options->json, "Print it as JSON");
    command->add_flag(
        "--depth", options->depth,
        "Certify the driver's depths: stored codes against exact planes, and the unit "
        "of polygon offset (docs/depth_precision.md)");
    command->add_option("--device", options->device, "Look at this EGL device");
    command->footer("Exit status: 0 if GL and Embree work, 4 if not.");
    command->callback([options] {
        const Findings findings = look(options->device, options->depth);
        print(options->json ? findings_json(findings).dump(2) + "\n" : to_text(findings));
        if (!findings.gl) {
            throw CLI::RuntimeError(4);
        }
    });
}

} // namespace gnomon::cli
