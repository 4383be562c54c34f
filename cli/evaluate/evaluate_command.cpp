#include "cli/commands.hpp"

#include "analysis/evaluate/evaluate.hpp"
#include "api/compare.hpp"
#include "api/loaded_case.hpp"
#include "api/memory.hpp"
#include "cli/exit_codes.hpp"
#include "cli/options/output_files.hpp"
#include "cli/runs/comparison_recorder.hpp"
#include "cli/system/process.hpp"
#include "cli/system/terminal.hpp"
#include "methods/key_table.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/pictures/picture.hpp"
#include "reports/tables/comparison_table.hpp"
#include "reports/text/answer.hpp"
#include "scene/case/file.hpp"
#include "scene/case/keys.hpp"
#include "scene/error.hpp"
#include "store/case/case_files.hpp"
#include "store/exr/aov.hpp"
#include "store/json_values.hpp"
#include "store/shell_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

struct EvaluateOptions {
    std::string path;
    std::string from;
    bool check = false;
    bool json = false;
    bool verbose = false;
    std::string aov_path;
    std::string picture_path;
    std::string folder; ///< RUN
    bool force = false;
    std::optional<double> tolerance_m;
    int threads = 0;
};

/// Checks before the work that the outputs can be written.
void require_writable_results(const EvaluateOptions& options, const scene::CaseFile& file)
{
    const std::array outputs{
        OutputOption{"--aov", options.aov_path, store::OutputKind::layers},
        OutputOption{"--picture", options.picture_path, store::OutputKind::picture}};
    std::vector<InputFile> inputs{{"the case", file.path.string()}};
    for (const scene::CaseImageSource& image : file.images) {
        inputs.push_back({"the case's image", image.path.string()});
    }
    if (file.map) {
        inputs.push_back({"the case's map", file.map->path.string()});
    }
    require_outputs(outputs, inputs);
}

void require_sound_tolerance(const EvaluateOptions& options)
{
    if (options.tolerance_m &&
        !(std::isfinite(*options.tolerance_m) && *options.tolerance_m >= 0)) {
        throw scene::InputError(fmt::format("--tolerance-m {}: must be a number of metres from 0",
                                            *options.tolerance_m));
    }
}

void print_check(const EvaluateOptions& options, const analysis::ImportCheck& check)
{
    print(options.json ? reports::check_json(check) : reports::check_text(check));
    if (!check.mistake.empty()) {
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

std::string evaluate_command(const EvaluateOptions& options)
{
    std::vector<std::string> words{"gnomon", "evaluate", options.path};
    if (!options.from.empty()) {
        words.insert(words.end(), {"--from", options.from});
    }
    return store::shell_text(words);
}

void record(ComparisonRecorder& run, const EvaluateOptions& options, const scene::CaseFile& file,
            const analysis::Comparison& comparison)
{
    scene::JobSource source = file.source;
    source.cases = {{file.name, {}}};
    run.record(std::move(source), file.name, {&comparison, 1}, {}, file.text,
               evaluate_command(options));
}

void write_evaluation(const EvaluateOptions& options, const analysis::Comparison& comparison)
{
    if (!options.aov_path.empty()) {
        store::write_aov(options.aov_path, comparison, api::points_of(comparison));
        announce_output("evaluate", options.aov_path);
    }
    if (!options.picture_path.empty()) {
        reports::write_picture(options.picture_path, comparison);
        announce_output("evaluate", options.picture_path);
    }
    print(options.json      ? reports::comparison_json(comparison)
          : options.verbose ? reports::comparison_table(comparison)
                            : reports::answer_text(comparison, {stdout_has_colours()}));
}

void evaluate(const EvaluateOptions& options)
{
    require_sound_tolerance(options);
    const scene::CaseFile file =
        scene::read_case_file(options.path, options.from, methods::key_table());
    require_writable_results(options, file);
    scene::CaseLayers layers = store::read_case_layers(file, api::available_memory_bytes());
    const api::CaseMesh mesh{file, options.threads};
    const api::LoadedCase loaded{file, std::move(layers), mesh};
    analysis::CheckedCase checked = loaded.check(options.tolerance_m);
    if (options.check) {
        print_check(options, checked.check);
        return;
    }
    if (!checked.check.mistake.empty()) {
        throw scene::InputError(
            fmt::format("{}: {}", loaded.file().source.name, checked.check.sentence));
    }
    std::optional<ComparisonRecorder> run;
    if (!options.folder.empty()) {
        run.emplace(options.folder, options.force);
    }
    const analysis::Comparison comparison = loaded.evaluate(std::move(checked));
    if (run) {
        record(*run, options, loaded.file(), comparison);
        announce_output("evaluate", options.folder);
    }
    write_evaluation(options, comparison);
}

} // namespace

void add_evaluate_command(CLI::App& program)
{
    auto options = std::make_shared<EvaluateOptions>();
    CLI::App* command = program.add_subcommand(
        "evaluate", "Compare another renderer's shadow mask with the exact truth");
    command
        ->add_option("CASE", options->path,
                     "A folder with case.toml, an image and a mesh, or its case.toml "
                     "(docs/evaluate.md)")
        ->required();
    command
        ->add_option("--from", options->from,
                     "Conventions of an exporter: axes, units, names of channels")
        ->check(CLI::IsMember(scene::exporter_names()));
    command->add_flag("--check", options->check,
                      "Only find out whether the case can be scored; exit status 1 if it looks "
                      "like a mistake");
    command->add_flag("--json", options->json, "Print the result as JSON (docs/json_schema.md)");
    command->add_flag("--verbose", options->verbose,
                      "Print every number as tables: classes, causes, the bias curve, objects");
    command->add_option("--aov", options->aov_path,
                        "Write every layer into one EXR file (docs/aov.md)");
    command->add_option(
        "--picture", options->picture_path,
        "Write a labelled picture: the shadows, the true ones, the errors, those that the "
        "recommended bias leaves (PNG)");
    command->add_option("--out", options->folder,
                        "RUN, a folder for the result, for `report`, `gate` and `baseline`");
    command->add_flag("--force", options->force,
                      "Let --out replace another scene's run, or a sweep");
    command->add_option(
        "--tolerance-m", options->tolerance_m,
        "How far positions may be from the mesh, at 99 % of them [m]; default: 2^-16 "
        "of the largest coordinate");
    command->add_option("--threads", options->threads, "Threads of the reference; 0: all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->footer("Examples:\n"
                    "  gnomon evaluate case\n"
                    "  gnomon evaluate case --check\n"
                    "  gnomon evaluate case --from blender --picture errors.png\n"
                    "  gnomon evaluate case --out run");
    command->callback([options] { evaluate(*options); });
}

} // namespace gnomon::cli
