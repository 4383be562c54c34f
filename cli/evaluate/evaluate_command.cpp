#include "cli/evaluate/evaluate_command.hpp"

#include "analysis/evaluate/camera_positions.hpp"
#include "analysis/evaluate/evaluate.hpp"
#include "cli/compare/compare_run.hpp"
#include "cli/compare/kept_pixels.hpp"
#include "cli/exit_codes.hpp"
#include "cli/output_files.hpp"
#include "cli/system/memory.hpp"
#include "cli/system/standard_output.hpp"
#include "reference_rt/light/exact_light.hpp"
#include "reference_rt/rounded/rounded_truth.hpp"
#include "reference_rt/truth.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/json/evaluation_json.hpp"
#include "reports/pictures/picture.hpp"
#include "reports/tables/comparison_table.hpp"
#include "reports/tables/evaluation_table.hpp"
#include "scene/case/file.hpp"
#include "scene/case/space.hpp"
#include "scene/error.hpp"
#include "scene/load_scene.hpp"
#include "scene/one_line.hpp"
#include "store/case/case_read.hpp"
#include "store/exr/aov_write.hpp"
#include "store/shell_text.hpp"

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
    std::string aov_path;
    std::string picture_path;
    std::string folder; ///< RUN
    bool force = false;
    std::optional<double> tolerance_m;
    int threads = 0;
};

/// Does the work; what it refuses about keys is said of those that the case has.
template <typename Work>
auto in_words_of(const scene::CaseFile& file, const Work& work)
{
    try {
        return work();
    } catch (const scene::InputError& error) {
        throw scene::InputError(scene::case_message(file, error.what()));
    }
}

/// A case with everything that it names in memory, with its mesh loaded by Embree.
class CaseSession {
public:
    CaseSession(scene::CaseFile file, int threads)
        : file_{std::move(file)},
          layers_{store::read_case_layers(file_, available_memory_bytes())},
          mesh_{load_mesh(file_)},
          reference_{mesh_, {threads}}
    {
        set_image_size();
        if (!layers_.has_positions) {
            in_words_of(file_, [&] { take_positions(threads); });
        }
    }

    [[nodiscard]] const scene::CaseFile& file() const { return file_; }
    [[nodiscard]] analysis::Case subject() const { return {file_, layers_, mesh_}; }

    /// Valid as long as the session.
    [[nodiscard]] analysis::CaseTruth truth(int threads) const
    {
        analysis::CaseTruth truth;
        truth.nearest_surfaces = [this, threads](std::span<const scene::Vec3d> points,
                                                 std::span<const scene::SurfaceScope> scopes) {
            return reference_rt::nearest_surfaces(reference_, points, scopes, threads);
        };
        truth.find_truth = [this, threads](const scene::Light& light,
                                           const scene::RoundedReceivers& receivers) {
            return reference_rt::compute_rounded_truth(reference_, light, receivers, threads);
        };
        truth.find_blockers =
            [this, threads](const scene::Light& light, const scene::RoundedReceivers& receivers,
                            const scene::RoundedTruth& found, std::span<const std::size_t> pixels) {
                return reference_rt::find_rounded_blockers(reference_, light, receivers, found,
                                                           pixels, threads);
            };
        truth.make_exact_light = [this, threads](const scene::Job& job, const scene::View& view,
                                                 const scene::ReceiverLayers& receivers) {
            return reference_rt::make_exact_light(reference_, view, receivers.triangle,
                                                  job.shadow_map.resolution_texels,
                                                  job.shadow_map.cull, threads);
        };
        truth.embree = reference_rt::embree_version();
        truth.gnomon = GNOMON_VERSION;
        return truth;
    }

private:
    static scene::TriangleScene load_mesh(const scene::CaseFile& file)
    {
        return in_words_of(file, [&] {
            // An offset is compared with those of both kinds.
            const bool is_offset = file.says("bias.normal_texels") || file.says("bias.normal_m") ||
                                   file.says("bias.normal_from");
            const auto normals =
                is_offset ? scene::VertexNormals::kept : scene::VertexNormals::dropped;
            return scene::move_to_space(
                scene::load_scene(scene::make_job(file.source).scene, normals).scene, file.space);
        });
    }

    /// What the centres of the camera's pixels show.
    void take_positions(int threads)
    {
        scene::Job job = scene::make_job(file_.source);
        job.image = layers_.size();
        const scene::View view = scene::resolve_view(job, mesh_, {});
        const auto points = reference_rt::receiver_points(
            mesh_, view, reference_rt::first_triangles(reference_, view, threads));
        try {
            analysis::take_camera_positions(layers_, mesh_, view, points,
                                            file_.space.is_mirrored());
        } catch (const scene::InputError& error) {
            throw scene::InputError(fmt::format("{}: {}", file_.source.name, error.what()));
        }
    }

    /// The image says it, and a run's configuration names it.
    void set_image_size()
    {
        const scene::ImageSize size = layers_.size();
        for (const auto& [key, pixels] :
             {std::pair{"image.width", size.width_px}, {"image.height", size.height_px}}) {
            file_.source.file.push_back({scene::find_key(key), std::int64_t{pixels},
                                         scene::one_line(file_.images.front().path.string())});
        }
    }

    scene::CaseFile file_;
    scene::CaseLayers layers_;
    scene::TriangleScene mesh_;
    reference_rt::ReferenceScene reference_;
};

/// Before the work, not after it.
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

void record(CompareRun& run, const EvaluateOptions& options, const scene::CaseFile& file,
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
        store::write_aov(options.aov_path, comparison, points_of(comparison));
    }
    if (!options.picture_path.empty()) {
        reports::write_picture(options.picture_path, comparison);
    }
    print(options.json ? reports::comparison_json(comparison)
                       : reports::comparison_table(comparison));
}

void evaluate(const EvaluateOptions& options)
{
    require_sound_tolerance(options);
    const scene::CaseFile file = scene::read_case_file(options.path, options.from);
    require_writable_results(options, file);
    const CaseSession session{file, options.threads};
    const analysis::CaseTruth truth = session.truth(options.threads);
    analysis::CheckedCase checked = in_words_of(session.file(), [&] {
        return analysis::check_case(session.subject(), truth, options.tolerance_m);
    });
    if (options.check) {
        print_check(options, checked.check);
        return;
    }
    if (!checked.check.mistake.empty()) {
        throw scene::InputError(
            fmt::format("{}: {}", session.file().source.name, checked.check.sentence));
    }
    std::optional<CompareRun> run;
    if (!options.folder.empty()) {
        run.emplace(options.folder, options.force);
    }
    const analysis::Comparison comparison =
        analysis::evaluate(session.subject(), std::move(checked), truth);
    if (run) {
        record(*run, options, session.file(), comparison);
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
    command->add_option("--aov", options->aov_path,
                        "Write every layer into one EXR file (docs/aov.md)");
    command->add_option("--picture", options->picture_path,
                        "Write a labelled picture: the shadows, the true ones, the errors (PNG)");
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
