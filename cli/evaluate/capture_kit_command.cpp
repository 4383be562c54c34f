#include "cli/evaluate/capture_kit_command.hpp"

#include "cli/commands.hpp"
#include "cli/options/output_files.hpp"
#include "cli/system/process.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace gnomon::cli {
namespace {

struct KitOptions {
    std::string folder;
    bool force = false;
};

void write_kit(const KitOptions& options)
{
    const std::filesystem::path folder{options.folder};
    for (const KitFile& file : capture_kit_files()) {
        require_absent(folder / file.name, options.force, "name another folder");
    }
    store::make_folder(folder);
    std::string written;
    for (const KitFile& file : capture_kit_files()) {
        const std::filesystem::path path = folder / file.name;
        store::write_file(path, file.text);
        written += fmt::format("{}\n", path.string());
    }
    print(written);
}

} // namespace

void add_capture_kit_command(CLI::App& program)
{
    auto options = std::make_shared<KitOptions>();
    CLI::App* command = program.add_subcommand(
        "capture-kit", "Write what another renderer needs to make a case for `evaluate`");
    command->add_option("DIR", options->folder, "The folder to write to")->required();
    command->add_flag("--force", options->force, "Replace the kit's files where they exist");
    command->footer("GLSL and HLSL for the mask and the positions, a script that packs them into\n"
                    "aov.exr, a case.toml to fill in, and how to go on.\n\nExamples:\n"
                    "  gnomon capture-kit kit\n"
                    "  gnomon evaluate my_case --check");
    command->callback([options] { write_kit(*options); });
}

} // namespace gnomon::cli
