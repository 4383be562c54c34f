#include "cli/commands.hpp"

#include "cli/system/standard_output.hpp"
#include "reports/json/scenes_json.hpp"
#include "reports/tables/scenes_table.hpp"
#include "scene/builtin/scenes.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace gnomon::cli {

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

} // namespace gnomon::cli
