#include "cli/commands.hpp"

#include "cli/options/output_files.hpp"
#include "cli/system/standard_output.hpp"
#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "store/output_file.hpp"
#include "store/output_name.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

void init(const std::string& path, const std::string& preset, bool force)
{
    if (path.empty()) {
        print(scene::commented_job_file(preset, methods::key_table()));
        return;
    }
    store::require_output_name(path, store::OutputKind::job);
    require_absent(path, force, "name another");
    store::write_file(path, scene::commented_job_file(preset, methods::key_table()));
}

} // namespace

void add_init_command(CLI::App& program)
{
    struct Options {
        std::string path;
        std::string preset;
        bool force = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("init", "Write a commented job file with every key at its default");
    command->add_option("FILE", options->path, "Where to write it; default: standard output");
    command->add_option("--preset", options->preset,
                        "With the values of a preset, which `gnomon presets` lists");
    command->add_flag("--force", options->force, "Replace an existing file");
    command->footer("Examples:\n"
                    "  gnomon init job.toml\n"
                    "  gnomon init bevy.toml --preset bevy\n"
                    "  gnomon compare job.toml");
    command->callback([options] { init(options->path, options->preset, options->force); });
}

} // namespace gnomon::cli
