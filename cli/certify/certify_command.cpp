#include "cli/commands.hpp"

#include "cli/exit_codes.hpp"
#include "cli/options/job_options.hpp"
#include "cli/system/process.hpp"
#include "reference_rt/certificate/certificate.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"
#include "store/exr/aov.hpp"
#include "store/exr/header.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace gnomon::cli {
namespace {

using nlohmann::ordered_json;
using reference_rt::Certificate;

struct CertifyOptions {
    std::string aov_path;
    JobOptions job;
    std::optional<std::uint64_t> sample;
    std::uint64_t seed = 0;
    int threads = 0;
    bool json = false;
};

/// Prints progress on stderr every 2 s.
class ProgressLines {
public:
    void operator()(std::string_view stage, std::uint64_t done, std::uint64_t total)
    {
        const auto now = std::chrono::steady_clock::now();
        if (now >= next_) {
            fmt::print(stderr, "gnomon certify: {}: {} of {} pixels\n", stage, done, total);
            next_ = now + interval;
        }
    }

private:
    static constexpr std::chrono::seconds interval{2};
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
};

void require_equal(const CertifyOptions& options, const store::Aov& aov, const std::string& name,
                   const std::string& expected)
{
    const auto found = aov.texts.find(name);
    const std::string text = found == aov.texts.end() ? "missing" : found->second;
    if (text != expected) {
        throw scene::InputError(fmt::format(
            "{}: gnomon:{} is {} but the job's is {}: give the job that the AOV was made from",
            options.aov_path, name, text.substr(0, 200), expected));
    }
}

/// Requires that the AOV was made from this job.
void require_inputs(const CertifyOptions& options, const store::Aov& aov,
                    const scene::TriangleScene& scene, const scene::View& view)
{
    require_equal(options, aov, "scene_hash", scene::content_hash(scene));
    for (const store::ExactInput& input : store::exact_inputs(view)) {
        require_equal(options, aov, input.name, fmt::format("{}", fmt::join(input.values, " ")));
    }
}

ordered_json by_class(const Certificate::ClassCounts& counts)
{
    ordered_json json;
    for (std::size_t c = 0; c < counts.size(); ++c) {
        json[std::string{scene::pixel_class_names[c]}] = counts[c];
    }
    return json;
}

std::string certificate_json(const CertifyOptions& options, const Certificate& certificate)
{
    const auto bound = certificate.error_rate_bound();
    ordered_json json{{"schema", 1}, {"certified", certificate.is_certified()}};
    json["pixels"] = by_class(certificate.claimed);
    json["witnesses"] = {{"checked", certificate.witnesses}, {"seams", certificate.seams}};
    json["positions"] = {{"checked", certificate.positions}};
    json["sample"] = {{"seed", options.seed},
                      {"surface_pixels", certificate.surface_pixels},
                      {"drawn", certificate.sampled},
                      {"derived", by_class(certificate.derived)},
                      {"indeterminate_kinds",
                       {{"silhouette", certificate.silhouettes},
                        {"vertex", certificate.vertices},
                        {"graze", certificate.grazes}}},
                      {"error_rate_bound", bound ? ordered_json(*bound) : ordered_json(nullptr)},
                      {"confidence", 0.95}};
    json["wrong"] = certificate.wrong;
    json["refutations"] = ordered_json::array();
    for (const reference_rt::Refutation& refutation : certificate.refutations) {
        const auto claimed = static_cast<std::size_t>(refutation.claimed);
        json["refutations"].push_back({{"x", refutation.x},
                                       {"y", refutation.y},
                                       {"claimed", scene::pixel_class_names[claimed]},
                                       {"reason", refutation.reason}});
    }
    return json.dump(2) + "\n";
}

/// What a certificate without refutations proves.
std::string proof(const Certificate& certificate)
{
    const auto bound = certificate.error_rate_bound();
    if (!bound) {
        return certificate.surface_pixels == 0
                   ? "every pixel shows background, and all were derived anew"
                   : "no surface pixel was derived: nothing is known of their classes";
    }
    if (*bound == 0) {
        return fmt::format("all {} surface pixels derived anew: none is wrong",
                           certificate.surface_pixels);
    }
    return fmt::format("0 wrong of {} drawn at random: at 95 % confidence at most {:.3g} % of the "
                       "{} surface pixels are wrong",
                       certificate.sampled, 100 * *bound, certificate.surface_pixels);
}

std::string refutation_lines(const Certificate& certificate)
{
    std::string text = fmt::format("refuted: {} wrong pixels\n", certificate.wrong);
    for (const reference_rt::Refutation& refutation : certificate.refutations) {
        text += fmt::format("  pixel ({}, {}), claimed {}: {}\n", refutation.x, refutation.y,
                            scene::pixel_class_names[static_cast<std::size_t>(refutation.claimed)],
                            refutation.reason);
    }
    return text;
}

std::string certificate_text(const CertifyOptions& options, const Certificate& certificate)
{
    std::string text = fmt::format("{:<14}{:>12}{:>16}\n", "class", "pixels", "derived anew");
    for (std::size_t c = 0; c < scene::pixel_class_count; ++c) {
        text += fmt::format("{:<14}{:>12}{:>16}\n", scene::pixel_class_names[c],
                            certificate.claimed[c], certificate.derived[c]);
    }
    text += fmt::format("\nwitnesses: {} blocked pixels checked, {} seams among them\n",
                        certificate.witnesses, certificate.seams);
    text += fmt::format("positions: P of {} pixels checked\n", certificate.positions);
    text += fmt::format("degenerate contacts derived: {} silhouette, {} vertex, {} graze\n",
                        certificate.silhouettes, certificate.vertices, certificate.grazes);
    if (!certificate.is_certified()) {
        return text + refutation_lines(certificate);
    }
    return text + fmt::format("certified, seed {}: {}\n", options.seed, proof(certificate));
}

void certify(const CertifyOptions& options)
{
    const scene::Job job = read_job(options.job).job;
    store::Aov aov = store::read_aov(options.aov_path, job.image, options.job.light.value_or(""));
    const scene::SceneFile file = scene::load_scene(job.scene);
    const scene::View view = scene::resolve_view(job, file.scene, file.defaults);
    require_inputs(options, aov, file.scene, view);
    const reference_rt::TruthClaims claims{std::move(aov.prim), std::move(aov.pixel_class),
                                           std::move(aov.truth), std::move(aov.witness),
                                           std::move(aov.position)};
    const Certificate certificate = reference_rt::certify(
        file.scene, view, claims, {options.sample, options.seed, options.threads, ProgressLines{}});
    print(options.json ? certificate_json(options, certificate)
                       : certificate_text(options, certificate));
    if (!certificate.is_certified()) {
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

} // namespace

void add_certify_command(CLI::App& program)
{
    auto options = std::make_shared<CertifyOptions>();
    CLI::App* command = program.add_subcommand(
        "certify", "Check the truth that an AOV holds, with rational arithmetic and brute force");
    command->add_option("AOV", options->aov_path, "A file that `gnomon compare --aov` wrote")
        ->required();
    add_job_options(*command, options->job);
    command->add_option("--sample", options->sample,
                        "Surface pixels to derive anew from all triangles; default: 3000, or 300 "
                        "above 100,000 triangles");
    command->add_option("--seed", options->seed, "Chooses the sample")->capture_default_str();
    command->add_option("--threads", options->threads, "Threads; 0: all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_flag("--json", options->json, "Print the certificate as JSON (docs/certify.md)");
    command->footer("Exit status: 0 certified; 1 refuted; 2 the AOV or the job is bad, or the AOV "
                    "is of another job.\n\nExamples:\n"
                    "  gnomon compare job.toml --aov job.exr\n"
                    "  gnomon certify job.exr job.toml\n"
                    "  gnomon certify wall.exr --builtin wall --sample 10000 --seed 7");
    command->callback([options] { certify(*options); });
}

} // namespace gnomon::cli
