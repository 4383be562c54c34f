#include "cli/commands.hpp"

#include <CLI/CLI.hpp>

#include <array>

namespace gnomon::cli {
namespace {

using AddCommand = void (*)(CLI::App&);

/// Every command, in the order of the help.
constexpr auto commands = std::to_array<AddCommand>(
    {add_compare_command,        add_certify_command,     add_tune_command,
     add_settings_command,       add_sweep_command,       add_plan_command,
     add_run_unit_command,       add_merge_command,       add_status_command,
     add_report_command,         add_gate_command,        add_baseline_command,
     add_evaluate_command,       add_capture_kit_command, add_renderers_command,
     add_renderer_check_command, add_figure_command,      add_depth_command,
     add_scenes_command,         add_methods_command,     add_presets_command,
     add_init_command,           add_doctor_command,      add_completion_command,
     add_manual_command,         add_help_command});

} // namespace

void describe_program(CLI::App& program)
{
    program.name("gnomon");
    program.require_subcommand(1);
    program.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    program.footer(
        "Examples:\n"
        "  gnomon compare --builtin sphere-plane\n"
        "  gnomon compare model.glb --set scene.ground=true --picture model.png\n"
        "  gnomon init job.toml\n\n"
        "Exit status: 0 done; 1 `gate` finds a regression, `certify` refutes, no setting meets\n"
        "`tune`'s limits, or `evaluate --check` finds a mistake; 2 usage, or a job, scene or case "
        "that is\nbad, missing or unreadable; 3 a baseline is missing, or of another environment; "
        "4 GL, Embree\nor output failed; 5 a run is incomplete; 130 interrupted.");
    for (const AddCommand add : commands) {
        add(program);
    }
}

} // namespace gnomon::cli
