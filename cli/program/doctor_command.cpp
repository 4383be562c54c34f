#include "cli/commands.hpp"

#include "api/memory.hpp"
#include "cli/program/depth_certificate.hpp"
#include "cli/system/standard_output.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/depth_formats.hpp"
#include "raster_gl/device_list.hpp"
#include "reference_rt/truth.hpp"
#include "reports/depth/depth_certificate_report.hpp"
#include "reports/pictures/canvas.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What was found; `problems` says what is missing and how to get it.
struct Findings {
    std::vector<raster_gl::DeviceInfo> devices;
    std::optional<raster_gl::GlFacts> gl;
    std::vector<raster_gl::FormatSupport> formats;
    reports::DriverCertificate certificate; ///< empty if it was not asked for
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

Json to_json(const Findings& findings)
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
        print(options->json ? to_json(findings).dump(2) + "\n" : to_text(findings));
        if (!findings.gl) {
            throw CLI::RuntimeError(4);
        }
    });
}

} // namespace gnomon::cli
