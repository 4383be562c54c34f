#include "cli/commands.hpp"

#include "cli/renderer/protocol/renderer_command.hpp"
#include "cli/system/process.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// An installed renderer and the result of its check.
struct RendererState {
    InstalledRenderer renderer;
    std::optional<std::string> missing; ///< empty: it has no check; "": nothing is missing
};

std::vector<RendererState> renderer_states()
{
    std::vector<RendererState> states;
    for (InstalledRenderer& renderer : installed_renderers()) {
        auto missing =
            renderer.check.empty() ? std::nullopt : std::optional{missing_part(renderer.check)};
        states.push_back({std::move(renderer), std::move(missing)});
    }
    return states;
}

std::string renderers_json(const std::vector<RendererState>& states)
{
    AnswerJson list = AnswerJson::array();
    for (const auto& [renderer, missing] : states) {
        list.push_back(
            {{"name", renderer.name},
             {"title", renderer.title},
             {"folder", renderer.folder.string()},
             {"command", renderer.command},
             {"needs", renderer.needs},
             {"ready", missing ? AnswerJson(missing->empty()) : AnswerJson()},
             {"missing", missing && !missing->empty() ? AnswerJson(*missing) : AnswerJson()}});
    }
    return AnswerJson{{"schema", 1}, {"renderers", std::move(list)}}.dump(
               2, ' ', false, AnswerJson::error_handler_t::replace) +
           "\n";
}

std::string state_text(const std::optional<std::string>& missing)
{
    if (!missing) {
        return "unknown whether it is ready: its renderer.toml has no check";
    }
    return missing->empty() ? "ready" : fmt::format("not ready: {}", *missing);
}

std::string renderers_table(const std::vector<RendererState>& states)
{
    if (states.empty()) {
        return "no renderers installed; --renderer-command starts any program that speaks the "
               "protocol (docs/renderer_protocol.md)\n";
    }
    std::size_t width = 0;
    for (const RendererState& state : states) {
        width = std::max(width, state.renderer.name.size());
    }
    std::string text;
    for (const auto& [renderer, missing] : states) {
        text += fmt::format("{:{}}  {}\n{:{}}    {}\n", renderer.name, width, renderer.title, "",
                            width, state_text(missing));
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
        "renderers", "List the other renderers, which of them are ready, and what they need");
    command->add_flag("--json", *json, "Print them as JSON");
    command->footer("Example:\n"
                    "  gnomon renderers");
    command->callback([json] {
        const auto states = renderer_states();
        print(*json ? renderers_json(states) : renderers_table(states));
    });
}

} // namespace gnomon::cli
