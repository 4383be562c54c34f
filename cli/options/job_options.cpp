#include "cli/options/job_options.hpp"

#include "api/loaded_scene.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/renderer_choice.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_axes.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"
#include "store/run/run_commands.hpp"
#include "store/shell_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace gnomon::cli {
namespace {

/// Removes blanks at both ends: "bias.constant = 0.01" may be pasted from a job file.
std::string trimmed(const std::string& text)
{
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? ""
                                      : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<scene::Override> overrides(const std::vector<std::string>& settings)
{
    std::vector<scene::Override> result;
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw scene::InputError(fmt::format(
                "--set {}: write KEY=VALUE, e.g. --set shadow_map.resolution=2048", setting));
        }
        result.push_back({trimmed(setting.substr(0, equals)), trimmed(setting.substr(equals + 1))});
    }
    return result;
}

void require_one_job(const JobOptions& options)
{
    const bool has_scene = !options.job_path.empty() || !options.builtin.empty();
    if (!has_scene && options.preset.empty()) {
        throw scene::InputError(
            "no job: give a job file, a scene file, or --builtin NAME (`gnomon scenes`)");
    }
    if (!options.job_path.empty() && !options.builtin.empty()) {
        throw scene::InputError("JOB and --builtin are mutually exclusive");
    }
    if (options.job_path.empty() && !options.case_name.empty()) {
        throw scene::InputError(fmt::format("--case needs a job file: a {} has no cases",
                                            options.builtin.empty() ? "preset" : "built-in scene"));
    }
}

/// @param text  the job file's text; null to read the file.
scene::JobSource source_of(const JobOptions& options, const std::vector<scene::Override>& settings,
                           const std::string* text)
{
    if (!options.job_path.empty()) {
        return text == nullptr ? scene::read_job_source(options.job_path, settings, options.preset,
                                                        options.keys)
                               : scene::job_source_of_text(options.job_path, *text, settings,
                                                           options.preset, options.keys);
    }
    return options.builtin.empty()
               ? scene::preset_job_source(options.preset, settings, options.keys)
               : scene::builtin_job_source(options.builtin, settings, options.preset, options.keys);
}

scene::JobSource with_light(const scene::JobSource& source, const JobOptions& options)
{
    return options.light ? scene::only_light(source, *options.light) : source;
}

} // namespace

void add_job_options(CLI::App& command, JobOptions& options)
{
    command.add_option("JOB", options.job_path,
                       "A job file (.toml), or a scene file (.gltf .glb .obj .ply) for a job of "
                       "defaults");
    command.add_option("--builtin", options.builtin,
                       "A built-in scene with its own job; `gnomon scenes` lists them");
    command
        .add_option("--set", options.settings,
                    "KEY=VALUE overrides a key of the job, e.g. bias.constant=0.001")
        ->allow_extra_args(false);
    command.add_option("--preset", options.preset,
                       "Take the shadow map of a lesson or an engine, with its own scene where no "
                       "other is given; `gnomon presets` lists them");
    command.add_option("--case", options.case_name, "Lay this [[case]] of the job file over it");
    command.add_option("--light", options.light,
                       "Of a job with several [[lights]], take this one alone");
}

scene::JobFile read_job(const JobOptions& options)
{
    return scene::job_of(read_job_source(options), options.case_name);
}

JobOptions of_light(const JobOptions& options, const std::string& light)
{
    JobOptions chosen = options;
    if (!light.empty()) {
        chosen.light = light;
    }
    return chosen;
}

void require_job_of_gl(const JobOptions& options)
{
    const std::string renderer =
        options.job_path.empty() ? std::string{} : scene::renderer_of_job(options.job_path);
    if (!renderer.empty()) {
        throw scene::InputError(fmt::format(
            "{}: renderer = {}: this command only measures GL's shadows; compare, sweep and "
            "tune drive other renderers: remove the key",
            scene::one_line(options.job_path), scene::toml_quoted(renderer)));
    }
}

scene::JobSource read_job_source(const JobOptions& options)
{
    require_one_job(options);
    require_job_of_gl(options);
    return read_any_job_source(options);
}

std::vector<std::string> axis_arguments(std::vector<std::string> axes, const JobOptions& options)
{
    for (std::string& argument : axes) {
        argument =
            scene::axis_argument_of_light(*options.keys, argument, options.light.value_or(""));
    }
    return axes;
}

scene::JobSource read_any_job_source(const JobOptions& options)
{
    require_one_job(options);
    return with_light(source_of(options, overrides(options.settings), nullptr), options);
}

scene::JobSource job_source_of_text(const JobOptions& options, const std::string& text)
{
    require_one_job(options);
    return with_light(source_of(options, overrides(options.settings), &text), options);
}

std::string job_text(const JobOptions& options)
{
    if (options.job_path.empty()) {
        const std::string preset =
            options.preset.empty() ? "" : fmt::format("preset = \"{}\"\n", options.preset);
        return options.builtin.empty()
                   ? preset
                   : fmt::format("{}[scene]\nbuiltin = \"{}\"\n", preset, options.builtin);
    }
    if (!options.job_path.ends_with(".toml")) {
        return fmt::format("# {}\n", options.job_path);
    }
    std::ifstream file{options.job_path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
}

std::string command_text(std::string_view command, const JobOptions& options,
                         const std::vector<std::string>& axes)
{
    std::vector<std::string> words{"gnomon", std::string{command}};
    const auto add = [&](std::string_view option, const std::string& value) {
        if (!value.empty()) {
            words.emplace_back(option);
            words.push_back(value);
        }
    };
    if (!options.job_path.empty()) {
        words.push_back(options.job_path);
    }
    add("--builtin", options.builtin);
    add("--preset", options.preset);
    add("--case", options.case_name);
    if (options.light) {
        words.push_back(store::light_option(*options.light));
    }
    for (const std::string& setting : options.settings) {
        add("--set", setting);
    }
    for (const std::string& axis : axes) {
        add("--axis", axis);
    }
    return store::shell_text(words);
}

void add_session_options(CLI::App& command, api::SessionOptions& options)
{
    command.add_option(
        "--device", options.device,
        "EGL device, as `gnomon doctor` numbers them; default: the first that works");
    command.add_option("--threads", options.threads, "Threads of the reference; 0: all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

} // namespace gnomon::cli
