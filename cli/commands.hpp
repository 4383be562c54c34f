#pragma once

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Describes the program: its commands in the order of their list. Help, completion, the manual
/// page and docs/commands.md are made from what it says.
void describe_program(CLI::App& program);

/// @name One for each command: adds it with its options; the callback runs it.
/// @{

/// `gnomon compare`: registers its options; the callback runs it.
void add_compare_command(CLI::App& program);

/// `gnomon certify`: registers its options; the callback runs it, and leaves with
/// CLI::RuntimeError{1} where it refutes.
void add_certify_command(CLI::App& program);

/// `gnomon tune JOB`: recommends settings that keep errors below the user's limits.
void add_tune_command(CLI::App& program);

/// Adds `gnomon sweep` to the program.
void add_sweep_command(CLI::App& program);

/// Adds `gnomon plan`.
void add_plan_command(CLI::App& program);

/// Adds `gnomon run-unit`.
void add_run_unit_command(CLI::App& program);

/// Adds `gnomon merge`.
void add_merge_command(CLI::App& program);

/// Adds `gnomon status`.
void add_status_command(CLI::App& program);

/// Adds `gnomon report`.
void add_report_command(CLI::App& program);

/// Adds `gnomon gate`.
void add_gate_command(CLI::App& program);

/// Adds `gnomon baseline save`, `list` and `diff`.
void add_baseline_command(CLI::App& program);

/// `gnomon evaluate CASE`: another renderer's shadow mask against the exact truth.
void add_evaluate_command(CLI::App& program);

/// `gnomon capture-kit DIR`: writes what an engine needs to make a case for `gnomon evaluate`.
void add_capture_kit_command(CLI::App& program);

/// Adds `gnomon renderers`.
void add_renderers_command(CLI::App& program);

/// Adds `gnomon renderer-check`.
void add_renderer_check_command(CLI::App& program);

/// Adds `gnomon figure`.
void add_figure_command(CLI::App& program);

/// `gnomon depth`: how precisely a depth buffer stores distances, by formula and by measurement.
void add_depth_command(CLI::App& program);

/// `gnomon scenes`: lists the built-in scenes and their parameters.
void add_scenes_command(CLI::App& program);

/// `gnomon methods`: lists how a map can decide, and what each way promises.
void add_methods_command(CLI::App& program);

/// `gnomon presets`: the shadow maps of lessons and engines, by themselves or on a job.
void add_presets_command(CLI::App& program);

/// `gnomon settings JOB --engine NAME`: what to type in an engine.
void add_settings_command(CLI::App& program);

/// `gnomon init [FILE]`: writes a commented job file.
void add_init_command(CLI::App& program);

/// `gnomon doctor`: what GL, Embree and drivers are here, what is missing, and how to get it.
void add_doctor_command(CLI::App& program);

/// `gnomon completion SHELL`.
void add_completion_command(CLI::App& program);

/// `gnomon manual`.
void add_manual_command(CLI::App& program);

/// `gnomon help [COMMAND…]`: what --help prints of it.
void add_help_command(CLI::App& program);

/// @}

} // namespace gnomon::cli
