#include "cli/program/simple_commands.hpp"

#include "cli/output_files.hpp"
#include "cli/system/standard_output.hpp"
#include "reports/json/scenes_json.hpp"
#include "reports/tables/scenes_table.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "store/output_file.hpp"
#include "store/output_name.hpp"

#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

void init(const std::string& path, bool force)
{
    if (path.empty()) {
        print(scene::commented_job_file());
        return;
    }
    store::require_output_name(path, store::OutputKind::job);
    require_absent(path, force, "name another");
    store::write_file(path, scene::commented_job_file());
}

} // namespace

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

void add_init_command(CLI::App& program)
{
    struct Options {
        std::string path;
        bool force = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("init", "Write a commented job file with every key at its default");
    command->add_option("FILE", options->path, "Where to write it; default: standard output");
    command->add_flag("--force", options->force, "Replace an existing file");
    command->footer("Examples:\n"
                    "  gnomon init job.toml\n"
                    "  gnomon compare job.toml");
    command->callback([options] { init(options->path, options->force); });
}

} // namespace gnomon::cli
