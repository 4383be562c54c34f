#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace gnomon::cli {

/// Adds every command to the program. Help, completion, the manual page and docs/commands.md are
/// generated from the result.
void describe_program(CLI::App& program);

/// The commands directly below the program or a command.
[[nodiscard]] std::vector<const CLI::App*> commands_below(const CLI::App& app);

/// One line that says what is wrong with a command line, with the nearest known command or option.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

/// @name Each adds one command with its options; the command's callback runs it. A callback throws
/// CLI::RuntimeError with the exit status if that is not 0.
/// @{

void add_compare_command(CLI::App& program);
void add_certify_command(CLI::App& program);
void add_tune_command(CLI::App& program);
void add_sweep_command(CLI::App& program);
void add_plan_command(CLI::App& program);
void add_run_unit_command(CLI::App& program);
void add_merge_command(CLI::App& program);
void add_status_command(CLI::App& program);
void add_report_command(CLI::App& program);
void add_gate_command(CLI::App& program);
void add_baseline_command(CLI::App& program);
void add_evaluate_command(CLI::App& program);
void add_capture_kit_command(CLI::App& program);
void add_renderers_command(CLI::App& program);
void add_renderer_check_command(CLI::App& program);
void add_figure_command(CLI::App& program);
void add_depth_command(CLI::App& program);
void add_scenes_command(CLI::App& program);
void add_methods_command(CLI::App& program);
void add_presets_command(CLI::App& program);
void add_settings_command(CLI::App& program);
void add_init_command(CLI::App& program);
void add_doctor_command(CLI::App& program);
void add_completion_command(CLI::App& program);
void add_manual_command(CLI::App& program);
void add_help_command(CLI::App& program);

/// @}

} // namespace gnomon::cli
