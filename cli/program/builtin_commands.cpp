#include "cli/commands.hpp"

#include "cli/options/output_files.hpp"
#include "cli/system/process.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "reports/catalogue/catalogue.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "store/output_file.hpp"

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

void add_scenes_command(CLI::App& program)
{
    auto json = std::make_shared<bool>(false);
    CLI::App* command =
        program.add_subcommand("scenes", "List the built-in scenes and their parameters");
    command->add_flag("--json", *json, "Print them as JSON");
    command->footer("Examples:\n"
                    "  gnomon scenes\n"
                    "  gnomon compare --builtin wall --set scene.wall.thickness_m=0.1");
    command->callback([json] {
        print(*json ? reports::scenes_json(scene::builtin_scenes())
                    : reports::scenes_table(scene::builtin_scenes()));
    });
}

void add_methods_command(CLI::App& program)
{
    auto json = std::make_shared<bool>(false);
    CLI::App* command = program.add_subcommand(
        "methods", "List the shadow methods, their filters and bias terms, and what they promise");
    command->add_flag("--json", *json, "Print them as JSON");
    command->footer("Examples:\n"
                    "  gnomon methods\n"
                    "  gnomon compare --builtin wall --set lookup.filter=pcf3");
    command->callback([json] {
        print(*json ? reports::methods_json(methods::methods())
                    : reports::methods_table(methods::methods()));
    });
}

} // namespace gnomon::cli
