#include "cli/commands.hpp"

#include "cli/system/standard_output.hpp"
#include "methods/list.hpp"
#include "reports/json/methods_json.hpp"
#include "reports/tables/methods_table.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace gnomon::cli {

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
