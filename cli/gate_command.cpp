#include "cli/gate_command.hpp"

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "cli/baseline_command.hpp"
#include "cli/exit_codes.hpp"
#include "cli/standard_output.hpp"
#include "reports/gate/gate_json.hpp"
#include "reports/gate/gate_names.hpp"
#include "reports/gate/gate_report.hpp"
#include "reports/gate/gate_rule_file.hpp"
#include "reports/gate/gate_run.hpp"
#include "reports/gate/gate_table.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace gnomon::cli {
namespace {

struct GateOptions {
    std::string run;
    std::string baseline;
    std::string rules;
    bool allows_environment = false;
    bool json = false;
};

void require_environment(const GateOptions& options, const reports::GateReport& report)
{
    if (options.allows_environment) {
        return;
    }
    std::string problem;
    if (!report.outcome.is_same_renderer) {
        problem = fmt::format("baseline of {}; run of {}",
                              reports::renderer_text(report.baseline.environment),
                              reports::renderer_text(report.run.results.environment));
    } else if (report.run.has_several_environments) {
        problem = "the run's results come from several environments";
    } else {
        return;
    }
    fmt::print(stderr,
               "gnomon: {}: {}: save a baseline of this environment, or pass --allow-environment\n",
               scene::one_line(options.baseline), problem);
    throw CLI::RuntimeError{exit_codes::other_environment};
}

/// A rule that matches nothing protects nothing. While results are missing it may be for that.
void require_matches(const reports::GateReport& report)
{
    if (report.outcome.unmatched_rules.empty() ||
        report.verdict == analysis::GateVerdict::incomplete) {
        return;
    }
    const analysis::GateRule& rule = report.rules[report.outcome.unmatched_rules.front()];
    throw scene::InputError(
        fmt::format("{}: rule \"{}\" matches nothing: no configuration is as `where` and `job` say "
                    "and has {}; correct it, or say optional = true",
                    rule.place, rule.id, rule.metric));
}

void end_as_verdict(analysis::GateVerdict verdict)
{
    if (verdict != analysis::GateVerdict::pass) {
        throw CLI::RuntimeError{verdict == analysis::GateVerdict::regression
                                    ? exit_codes::negative
                                    : exit_codes::incomplete};
    }
}

void gate(const GateOptions& options)
{
    reports::GateReport report;
    report.rules = options.rules.empty() ? analysis::default_gate_rules()
                                         : reports::read_gate_rules(options.rules);
    report.run = reports::read_gate_run(options.run);
    report.baseline_file = options.baseline;
    report.baseline = baseline_or_end(options.baseline);
    report.outcome = analysis::judge_run(report.baseline, report.run.results, report.rules);
    report.verdict =
        analysis::gate_verdict(report.outcome, report.rules, report.run.status.is_complete());
    require_environment(options, report);
    require_matches(report);
    print(options.json ? reports::gate_json(report) : reports::gate_table(report));
    end_as_verdict(report.verdict);
}

} // namespace

void add_gate_command(CLI::App& program)
{
    auto options = std::make_shared<GateOptions>();
    CLI::App* command = program.add_subcommand(
        "gate", "Hold a run to a baseline: nothing may be worse than it was");
    command
        ->add_option("RUN", options->run, "The folder of `gnomon sweep --out` or `compare --out`")
        ->required();
    command
        ->add_option("--baseline", options->baseline, "FILE, as `gnomon baseline save` writes it")
        ->required();
    command->add_option("--rules", options->rules,
                        "FILE of rules (docs/gate.md); default: no more wrong pixels than before");
    command->add_flag("--allow-environment", options->allows_environment,
                      "Compare with a baseline of another renderer, too");
    command->add_flag("--json", options->json, "Print it as JSON (docs/gate.md)");
    command->footer("Exit status: 0 pass; 1 regression; 2 there is no run in RUN, or a baseline or "
                    "rule is bad; 3 there is no baseline, or it is of another environment; 5 "
                    "results are missing.\n\nExamples:\n"
                    "  gnomon gate run --baseline baseline.json\n"
                    "  gnomon gate run --baseline baseline.json --rules gate.toml --json");
    command->callback([options] { gate(*options); });
}

} // namespace gnomon::cli
