#include "cli/commands.hpp"

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/compare.hpp"
#include "api/sweep/sweep.hpp"
#include "cli/exit_codes.hpp"
#include "cli/options/job_options.hpp"
#include "cli/options/output_files.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "cli/runs/watched_sweep.hpp"
#include "cli/sweep/extreme_pixels.hpp"
#include "cli/sweep/sweep_answer.hpp"
#include "cli/sweep/sweep_text.hpp"
#include "cli/system/process.hpp"
#include "cli/system/terminal.hpp"
#include "cli/units/cluster_sweep.hpp"
#include "cli/units/planned_sweep.hpp"
#include "reports/tables/run_status_text.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "store/run/run_status.hpp"
#include "store/shell_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// Sweeps of at most this many configurations keep all pixels by default.
constexpr std::uint64_t few_configurations = 20;

struct SweepOptions {
    JobOptions job;
    RendererOptions renderer;
    std::vector<std::string> axes;
    std::string folder;
    std::string shard = "1/1";
    std::string retry;
    std::string on;
    std::size_t units = 0;
    bool is_dry_run = false;
    bool json = false;
    bool keeps_pixels = false;
    bool keeps_no_pixels = false;
    bool verifies = false;
    bool is_quiet = false;
    bool allows_mixed = false;
    bool force = false;
    api::SessionOptions session;
};

/// Reads "2/5", the second of five parts.
store::Shard read_shard(const std::string& text)
{
    store::Shard shard;
    const char* const end = text.data() + text.size();
    const auto [slash, index_error] = std::from_chars(text.data(), end, shard.index);
    const bool has_slash = index_error == std::errc{} && slash != end && *slash == '/';
    const auto [stop, count_error] = std::from_chars(has_slash ? slash + 1 : end, end, shard.count);
    if (!has_slash || count_error != std::errc{} || stop != end || shard.index < 1 ||
        shard.index > shard.count || shard.count > 10'000) {
        throw scene::InputError(fmt::format(
            "--shard {}: must be k/n, the k-th of n parts, counted from 1: e.g. --shard 2/5",
            text));
    }
    return shard;
}

/// The configurations whose pixels are kept.
enum class KeptPixels : std::uint8_t { none, extremes, all };

KeptPixels kept_pixels(const SweepOptions& options, std::uint64_t configurations)
{
    if (options.keeps_pixels && options.keeps_no_pixels) {
        throw scene::InputError("--keep-pixels and --no-keep-pixels are mutually exclusive");
    }
    if (options.keeps_no_pixels) {
        return KeptPixels::none;
    }
    return options.keeps_pixels || configurations <= few_configurations ? KeptPixels::all
                                                                        : KeptPixels::extremes;
}

/// The options that a command to resume the sweep needs again.
std::string flags_text(const SweepOptions& options)
{
    std::string text;
    text += options.keeps_pixels ? " --keep-pixels" : "";
    text += options.keeps_no_pixels ? " --no-keep-pixels" : "";
    text += options.verifies ? " --verify" : "";
    text += options.allows_mixed ? " --allow-mixed" : "";
    text += options.on.empty() ? "" : fmt::format(" --on {}", store::shell_text({options.on}));
    text += options.units > 0 ? fmt::format(" --units {}", options.units) : "";
    text += options.session.device ? fmt::format(" --device {}", *options.session.device) : "";
    text +=
        options.session.threads > 0 ? fmt::format(" --threads {}", options.session.threads) : "";
    return text;
}

void print_plan(const SweepOptions& options, const scene::SweepSpace& space, bool keeps)
{
    const analysis::SweepCurves sweep_curves{space, keeps, GNOMON_VERSION};
    const auto& requests = sweep_curves.requests();
    const auto plan = analysis::make_plan(requests, analysis::camera_slots(requests));
    SweepSummary summary;
    summary.configurations = space.size();
    for (const analysis::Refusal& refusal : sweep_curves.refusals()) {
        summary.refused += refusal.ordinals.size();
        summary.first_refusal = sweep_curves.refusals().front().message;
    }
    summary.counts = plan.counts(requests);
    summary.estimated_seconds = analysis::estimate_seconds(plan, requests);
    summary.estimated_bytes = analysis::estimate_bytes(plan, requests);
    print(options.json ? plan_json(summary) : plan_text(space, summary));
}

int exit_code(const api::SweepOutcome& outcome)
{
    if (outcome.is_interrupted) {
        return exit_codes::interrupted;
    }
    if (outcome.done < outcome.configurations) {
        return exit_codes::incomplete;
    }
    return outcome.checks.are_passed() ? exit_codes::done : exit_codes::environment_failed;
}

/// Prints why the exit status is not 0.
void explain(const SweepOptions& options, const api::SweepOutcome& outcome, int code)
{
    if (outcome.is_interrupted) {
        fmt::print(stderr, "gnomon: interrupted; the same command goes on where this stopped\n");
    } else if (code == exit_codes::incomplete) {
        fmt::print(stderr, "gnomon: {} failed; `gnomon status {}` says why{}\n",
                   reports::counted(outcome.failed, "configuration"),
                   store::shell_text({options.folder}),
                   outcome.retriable > 0 ? ", --retry failed tries again" : "");
        if (outcome.failed > outcome.retriable) {
            fmt::print(stderr, "gnomon: {}\n",
                       reports::useless_retry_text(outcome.failed - outcome.retriable));
        }
    } else if (code == exit_codes::environment_failed) {
        fmt::print(stderr, "gnomon: {}\n", store::failed_checks_text(outcome.checks));
    }
}

api::SweepRunOptions run_options(const SweepOptions& options)
{
    api::SweepRunOptions run;
    run.folder = options.folder;
    run.verifies = options.verifies;
    run.retries_failed = !options.retry.empty();
    run.allows_mixed = options.allows_mixed;
    run.may_replace = options.force;
    run.job_text = job_text(options.job);
    run.command = command_text("sweep", options.job, options.axes) + flags_text(options) +
                  renderer_text(options.renderer);
    run.compare_command = command_text("compare", options.job) + renderer_text(options.renderer);
    run.session = options.session;
    return run;
}

void require_folder(const SweepOptions& options)
{
    if (options.folder.empty()) {
        throw scene::InputError("no --out RUN: name the folder for the results, or pass --dry-run "
                                "to print the plan");
    }
}

/// Prints what a sweep found, and says that its files were written.
void print_answer(const SweepOptions& options, const api::SweepOutcome& outcome)
{
    if (outcome.done > 0) {
        print(sweep_answer(options.folder, stdout_has_colours()));
    }
    if (!options.is_quiet) {
        announce_output("sweep", options.folder);
    }
}

/// Prints why the sweep failed, if it did, and throws the exit status.
void end_with(const SweepOptions& options, const api::SweepOutcome& outcome)
{
    const int code = exit_code(outcome);
    explain(options, outcome, code);
    if (code != exit_codes::done) {
        throw CLI::RuntimeError{code};
    }
}

/// Sweeps with another renderer.
void sweep_with(RendererCommand command, const SweepOptions& options)
{
    refuse_for_renderer({{"--shard", options.shard != "1/1"},
                         {"--verify", options.verifies},
                         {"--device", options.session.device.has_value()}});
    if (!options.is_dry_run) {
        require_folder(options);
    }
    DrivenRenderer renderer{
        renderer_settings(std::move(command), options.renderer, options.session.threads)};
    const scene::JobSource source = read_driven_job(renderer, options.job);
    const scene::SweepSpace space{source, axis_arguments(options.axes, options.job),
                                  options.job.case_name};
    if (options.is_dry_run) {
        print_plan(options, space, true);
        return;
    }
    api::SweepRunOptions run = run_options(options);
    run.keeps_pixels = kept_pixels(options, space.size()) == KeptPixels::all;
    const api::SweepOutcome outcome = sweep_renderer(space, run, renderer, options.is_quiet);
    print(sweep_outcome_text(options.folder, outcome,
                             fmt::format("{} by {}",
                                         reports::counted(outcome.counts.configurations, "frame"),
                                         renderer.hello().title())));
    print_answer(options, outcome);
    end_with(options, outcome);
}

/// Refuses options that workers of a cluster do not support.
void refuse_for_cluster(const SweepOptions& options)
{
    const std::initializer_list<std::pair<std::string_view, bool>> given{
        {"--renderer", options.renderer.name.has_value()},
        {"--renderer-command", options.renderer.command.has_value()},
        {"--shard", options.shard != "1/1"},
        {"--verify", options.verifies},
        {"--keep-pixels", options.keeps_pixels},
        {"--device", options.session.device.has_value()},
        {"--force", options.force}};
    for (const auto& [option, is_given] : given) {
        if (is_given) {
            throw scene::InputError(fmt::format("{} does not work with --on: remove it, or resume "
                                                "the sweep without --on",
                                                option));
        }
    }
}

/// Sweeps on the workers of a cluster.
void sweep_on(const SweepOptions& options)
{
    refuse_for_cluster(options);
    require_folder(options);
    ClusterSweepOptions cluster;
    cluster.cluster = options.on;
    cluster.job = options.job;
    cluster.axes = options.axes;
    cluster.units = options.units;
    cluster.folder = options.folder;
    cluster.command = command_text("sweep", options.job, options.axes) + flags_text(options);
    cluster.threads = options.session.threads;
    cluster.allows_mixed = options.allows_mixed;
    cluster.retries_failed = !options.retry.empty();
    cluster.is_quiet = options.is_quiet;
    const api::SweepOutcome outcome = sweep_on_cluster(cluster);
    print(fmt::format("{} of {} done{}: {}/results.csv\n", reports::grouped(outcome.done),
                      reports::counted(outcome.configurations, "configuration"),
                      outcome.failed > 0
                          ? fmt::format(", {} failed", reports::grouped(outcome.failed))
                          : std::string{},
                      options.folder));
    print_answer(options, outcome);
    end_with(options, outcome);
}

void sweep(const SweepOptions& options)
{
    if (!options.on.empty() && !options.is_dry_run) {
        return sweep_on(options);
    }
    if (auto renderer = chosen_renderer(options.renderer, options.job)) {
        sweep_with(std::move(*renderer), options);
        return;
    }
    const scene::JobSource source = read_job_source(options.job);
    const scene::SweepSpace space{source, axis_arguments(options.axes, options.job),
                                  options.job.case_name};
    const KeptPixels kept = kept_pixels(options, space.size());
    const bool keeps = kept == KeptPixels::all;
    const store::Shard shard = read_shard(options.shard);
    if (options.is_dry_run) {
        return print_plan(options, space, keeps);
    }
    require_folder(options);
    api::SweepRunOptions run = run_options(options);
    run.shard = shard;
    run.keeps_pixels = keeps;
    api::SweepOutcome outcome = watched_sweep(space, run, options.is_quiet);
    print(sweep_outcome_text(options.folder, outcome, counts_text(outcome.counts)));
    if (options.verifies) {
        print(fmt::format("  verified: {}\n", store::verification_text(outcome.checks)));
    }
    if (kept == KeptPixels::extremes && !outcome.is_interrupted && outcome.done > 0) {
        const auto names =
            keep_extreme_pixels(run.folder, space, source, options.job.case_name, options.session);
        if (!names.empty()) {
            print(fmt::format("  pixels kept: of {}; --keep-pixels keeps those of all\n",
                              fmt::join(names, ", ")));
        }
        outcome.is_interrupted = is_interrupted();
    }
    print_answer(options, outcome);
    end_with(options, outcome);
}

} // namespace

void add_sweep_command(CLI::App& program)
{
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command = program.add_subcommand(
        "sweep", "Compare a scene over any ranges of settings; resumes where it was stopped");
    add_job_options(*command, options->job);
    add_renderer_options(*command, options->renderer);
    command
        ->add_option("--axis", options->axes,
                     "KEY=VALUES adds an axis or replaces the job's: 512,1024,2048 or "
                     "{from=1e-6, to=0.1, count=50, scale=\"log\"}")
        ->allow_extra_args(false);
    command->add_option("--out", options->folder,
                        "RUN, the folder for the results (docs/sweep.md)");
    CLI::Option* const dry_run =
        command->add_flag("--dry-run", options->is_dry_run,
                          "Print what would be done, and roughly how long it takes, and stop");
    command->add_flag("--json", options->json, "With --dry-run: print the plan as JSON")
        ->needs(dry_run);
    command->add_flag("--keep-pixels", options->keeps_pixels,
                      "Keep every configuration's layers in RUN/pixels; the default for up to 20 "
                      "configurations. Of more, those of the best, the worst and the job's own are "
                      "kept");
    command->add_flag("--no-keep-pixels", options->keeps_no_pixels, "Keep none");
    command
        ->add_option("--shard", options->shard,
                     "k/n: compute the k-th of n parts; `gnomon merge` unites them")
        ->capture_default_str();
    command->add_option("--on", options->on,
                        "Compute in units on workers: local:N, N processes of one thread each on "
                        "this machine; dask://HOST:PORT; slurm, or slurm:OPTIONS with sbatch's "
                        "own, such as \"slurm:--partition=long --time=60\" (docs/scaling.md)");
    command
        ->add_option("--units", options->units,
                     "With --on: at most so many units; without it each takes about a minute")
        ->check(CLI::Range(std::size_t{1}, most_units));
    command->add_option("--retry", options->retry, "failed: compute failed configurations again")
        ->check(CLI::IsMember({"failed"}));
    command->add_flag("--verify", options->verifies,
                      "Run GL again with biases that put each bias curve to the test, and compare "
                      "every verdict; also of what is done already");
    command->add_flag("--allow-mixed", options->allows_mixed,
                      "Go on in a RUN that holds results of another driver or version");
    command->add_flag("--force", options->force, "Replace what RUN holds of another scene");
    command->add_flag("--quiet", options->is_quiet, "No progress on stderr");
    add_session_options(*command, options->session);
    command->footer(
        "Exit status: 0 all are done; 4 all are, but GL and the truth, or the bias curve, disagree "
        "where they must not; 5 some failed; 130 interrupted.\n\nExamples:\n"
        "  gnomon sweep job.toml --out run\n"
        "  gnomon sweep --builtin columns --out run --axis shadow_map.resolution=512,1024,2048 "
        "--axis 'bias.constant={from=1e-6, to=0.1, count=200, scale=\"log\"}'\n"
        "  gnomon sweep job.toml --dry-run");
    command->callback([options] { sweep(*options); });
}

} // namespace gnomon::cli
