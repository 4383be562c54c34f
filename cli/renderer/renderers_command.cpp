#include "cli/renderer/renderers_command.hpp"

#include "cli/renderer/renderer_command.hpp"
#include "cli/system/standard_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

std::string renderers_json(const std::vector<InstalledRenderer>& renderers)
{
    AnswerJson list = AnswerJson::array();
    for (const InstalledRenderer& renderer : renderers) {
        list.push_back({{"name", renderer.name},
                        {"title", renderer.title},
                        {"folder", renderer.folder.string()},
                        {"command", renderer.command},
                        {"needs", renderer.needs}});
    }
    return AnswerJson{{"schema", 1}, {"renderers", std::move(list)}}.dump(
               2, ' ', false, AnswerJson::error_handler_t::replace) +
           "\n";
}

std::string renderers_table(const std::vector<InstalledRenderer>& renderers)
{
    if (renderers.empty()) {
        return "no renderer is installed; --renderer-command starts any program that speaks the "
               "protocol (docs/renderer_protocol.md)\n";
    }
    std::size_t width = 0;
    for (const InstalledRenderer& renderer : renderers) {
        width = std::max(width, renderer.name.size());
    }
    std::string text;
    for (const InstalledRenderer& renderer : renderers) {
        text += fmt::format("{:{}}  {}\n", renderer.name, width, renderer.title);
        for (const std::string& need : renderer.needs) {
            text += fmt::format("{:{}}    needs {}\n", "", width, need);
        }
    }
    return text;
}

} // namespace

void add_renderers_command(CLI::App& program)
{
    auto json = std::make_shared<bool>(false);
    CLI::App* command = program.add_subcommand(
        "renderers", "List the other renderers that are installed, and what they need");
    command->add_flag("--json", *json, "Print them as JSON");
    command->footer("Example:\n"
                    "  gnomon renderers");
    command->callback([json] {
        const auto renderers = installed_renderers();
        print(*json ? renderers_json(renderers) : renderers_table(renderers));
    });
}

} // namespace gnomon::cli
