#include "cli/gate/gate_outputs.hpp"

#include "cli/system/standard_output.hpp"
#include "reports/gate/gate_github.hpp"
#include "reports/gate/gate_pictures.hpp"
#include "reports/gate/gate_table.hpp"
#include "scene/error.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <system_error>

namespace gnomon::cli {

namespace {

/// A step's whole summary may have 1 MiB: beyond, GitHub drops it.
constexpr std::uintmax_t most_summary_bytes = 1'000'000;

void append_summary(const std::filesystem::path& file, const reports::GateReport& report)
{
    std::error_code none;
    const std::uintmax_t known = std::filesystem::file_size(file, none);
    const std::uintmax_t used = none ? 0 : known;
    const std::string text =
        reports::github_summary(report, used < most_summary_bytes ? most_summary_bytes - used : 0);
    errno = 0;
    std::ofstream stream{file, std::ios::binary | std::ios::app};
    stream << text << std::flush;
    if (!stream) {
        throw scene::EnvironmentError(
            fmt::format("{}: cannot be written: {}; check GITHUB_STEP_SUMMARY",
                        scene::one_line(file.string()), std::strerror(errno)));
    }
}

} // namespace

void draw_gate_pictures(reports::GateReport& report, const std::filesystem::path& folder)
{
    if (!folder.empty()) {
        return reports::write_gate_pictures(report, folder);
    }
    try {
        reports::write_gate_pictures(report, report.run.folder / "gate");
    } catch (const scene::EnvironmentError& error) {
        fmt::print(stderr, "gnomon: no pictures: {}\n", error.what());
    }
}

void print_for_github(const reports::GateReport& report)
{
    // Names in the table may look like commands to the runner: it is told to take none until a word
    // that nobody can have put there.
    std::random_device random;
    const std::string word =
        fmt::format("gnomon-{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
    print(fmt::format("::stop-commands::{}\n{}::{}::\n{}", word,
                      reports::gate_table(report, reports::GateDetail::all), word,
                      reports::github_annotations(report)));
    const char* const file = std::getenv("GITHUB_STEP_SUMMARY");
    if (file != nullptr && *file != '\0') {
        append_summary(file, report);
    }
}

} // namespace gnomon::cli
