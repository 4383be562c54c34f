#include "cli/commands.hpp"

#include "cli/exit_codes.hpp"
#include "cli/renderer/check/renderer_check.hpp"
#include "cli/renderer/renderer_options.hpp"
#include "cli/system/process.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

struct RendererCheckOptions {
    RendererOptions renderer;
    bool json = false;
};

std::string findings_json(const std::vector<RuleFinding>& findings)
{
    AnswerJson rules = AnswerJson::array();
    for (const RuleFinding& finding : findings) {
        rules.push_back(
            {{"rule", finding.rule}, {"kept", finding.is_kept}, {"sentence", finding.sentence}});
    }
    const bool is_sound = std::ranges::all_of(findings, &RuleFinding::is_kept);
    return AnswerJson{{"schema", 1}, {"kept", is_sound}, {"rules", std::move(rules)}}.dump(
               2, ' ', false, AnswerJson::error_handler_t::replace) +
           "\n";
}

std::string findings_table(const std::vector<RuleFinding>& findings)
{
    std::size_t width = 0;
    for (const RuleFinding& finding : findings) {
        width = std::max(width, finding.rule.size());
    }
    std::string text;
    for (const RuleFinding& finding : findings) {
        text += fmt::format("{:6}  {:{}}  {}\n", finding.is_kept ? "ok" : "broken", finding.rule,
                            width, finding.sentence);
    }
    return text;
}

void check(const RendererCheckOptions& options)
{
    const auto findings = check_renderer(renderer_command(options.renderer), temporary_folder(),
                                         options.renderer.longest());
    print(options.json ? findings_json(findings) : findings_table(findings));
    if (!std::ranges::all_of(findings, &RuleFinding::is_kept)) {
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

} // namespace

void add_renderer_check_command(CLI::App& program)
{
    auto options = std::make_shared<RendererCheckOptions>();
    CLI::App* command = program.add_subcommand(
        "renderer-check", "Try another renderer against every rule of the protocol");
    command->add_option("NAME", options->renderer.name,
                        "An installed renderer; `gnomon renderers` lists them");
    command->add_option("--command", options->renderer.command,
                        "In its place: a program that speaks the protocol, and its arguments "
                        "(docs/renderer_protocol.md)");
    command->add_flag("--json", options->json, "Print what was found as JSON");
    add_renderer_timeout(*command, options->renderer);
    command->footer("Exit status: 0 every rule is kept; 1 one is broken.\n\n"
                    "Examples:\n"
                    "  gnomon renderer-check three\n"
                    "  gnomon renderer-check --command \"python3 my_renderer.py\"");
    command->callback([options] { check(*options); });
}

} // namespace gnomon::cli
