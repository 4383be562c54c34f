#include "cli/units/planned_sweep.hpp"

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "analysis/sweep/units.hpp"
#include "cli/options/job_options.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/fnv1a.hpp"
#include "scene/job/renderer_choice.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/load/scene_notes.hpp"
#include "scene/text.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <map>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

using analysis::SweepCurves;
using store::PlannedScene;
using store::PlannedUnit;
using store::UnitPlan;

store::PlannedJob planned_job(const JobOptions& options, const std::vector<std::string>& axes)
{
    store::PlannedJob job;
    job.path = options.job_path;
    const bool has_text = !job.path.empty() && !scene::is_scene_file(job.path);
    job.text = has_text ? scene::read_text_file(job.path, scene::one_line(job.path), "job file")
                        : std::string{};
    job.builtin = options.builtin;
    job.preset = options.preset;
    job.case_name = options.case_name;
    job.light = options.light;
    job.settings = options.settings;
    job.axes = axis_arguments(axes, options);
    return job;
}

/// What a job takes from its scene's file.
struct SceneUse {
    scene::LeftToFile left;
    scene::VertexNormals normals = scene::VertexNormals::dropped;

    friend auto operator<=>(const SceneUse&, const SceneUse&) = default;
};

/// Indexed by request.
std::vector<SceneUse> scene_uses(const SweepCurves& curves)
{
    std::vector<SceneUse> uses(curves.requests().size());
    tbb::parallel_for(std::size_t{0}, uses.size(), [&](std::size_t i) {
        const scene::Job job = curves.job(i);
        uses[i] = {scene::left_to_file(job), methods::vertex_normals(job)};
    });
    return uses;
}

/// Whether any request needs vertex normals: then all scenes are read with them.
scene::VertexNormals needed_normals(const std::vector<SceneUse>& uses)
{
    const bool are_kept = std::ranges::any_of(
        uses, [](const SceneUse& use) { return use.normals == scene::VertexNormals::kept; });
    return are_kept ? scene::VertexNormals::kept : scene::VertexNormals::dropped;
}

/// The scenes of a sweep, each read once.
class PlannedScenes {
public:
    /// @param folder  for packed scenes; empty: none are packed.
    PlannedScenes(const SweepCurves& curves, const std::filesystem::path& folder) : folder_{folder}
    {
        const std::vector<SceneUse> uses = scene_uses(curves);
        normals_ = needed_normals(uses);
        for (std::size_t i = 0; i < curves.requests().size(); ++i) {
            const std::string& keys = curves.requests()[i].keys.scene;
            const auto [entry, is_new] = known_.try_emplace(keys, scenes_.size());
            if (is_new) {
                read(curves.job(i), keys);
            }
            of_request_.push_back(entry->second);
            identities_.push_back(identity(curves, i, uses[i]));
        }
        if (!error_.empty() && std::ranges::all_of(scenes_, [](const PlannedScene& scene) {
                return scene.hash.empty();
            })) {
            throw scene::InputError(error_);
        }
    }

    /// In the order of the sweep.
    [[nodiscard]] const std::vector<PlannedScene>& scenes() const { return scenes_; }
    /// Indexed by request.
    [[nodiscard]] const std::vector<analysis::SceneIdentity>& identities() const
    {
        return identities_;
    }
    [[nodiscard]] const std::string& hash(std::size_t request) const
    {
        return scenes_[of_request_[request]].hash;
    }
    [[nodiscard]] scene::VertexNormals normals() const { return normals_; }

private:
    /// Cached for requests that use a scene in the same way, because making a job is slow.
    const analysis::SceneIdentity& identity(const SweepCurves& curves, std::size_t request,
                                            const SceneUse& use)
    {
        const std::size_t place = of_request_[request];
        const auto [entry, is_new] = identities_of_uses_.try_emplace({place, use});
        if (is_new) {
            const api::SceneContent& content = contents_[place];
            entry->second = analysis::identify_scene(curves.job(request), content.hash,
                                                     content.defaults, content.normals);
        }
        return entry->second;
    }

    void read(const scene::Job& job, const std::string& keys)
    {
        const std::string name = analysis::scene_name(job.scene);
        api::SceneContent content;
        try {
            if (folder_.empty() || job.scene.file.empty()) {
                content = api::content_of(scene::load_scene(job.scene, normals_));
            } else {
                const scene::SealedBytes packed = scene::pack_scene(job.scene, normals_);
                content =
                    api::content_of(scene::load_packed_scene(job.scene, packed.bytes(), normals_));
                write(planned_scene(name, keys, content), packed.bytes());
            }
        } catch (const scene::InputError& error) {
            error_ = error_.empty() ? error.what() : error_; // its configurations will fail
        }
        scenes_.push_back(planned_scene(name, keys, content));
        contents_.push_back(std::move(content));
    }

    void write(const PlannedScene& scene, std::span<const std::byte> packed) const
    {
        std::error_code error; // write_file reports it better
        std::filesystem::create_directories(folder_, error);
        store::write_file(packed_scene_path(folder_, scene), packed);
    }

    std::filesystem::path folder_;
    scene::VertexNormals normals_ = scene::VertexNormals::dropped;
    std::map<std::string, std::size_t> known_; ///< index of `scenes_` by keys
    std::map<std::pair<std::size_t, SceneUse>, analysis::SceneIdentity> identities_of_uses_;
    std::vector<PlannedScene> scenes_;
    std::vector<api::SceneContent> contents_;
    std::vector<std::size_t> of_request_;
    std::vector<analysis::SceneIdentity> identities_;
    std::string error_; ///< of the first unreadable scene
};

/// The units that have configurations.
std::vector<PlannedUnit> planned_units(const SweepCurves& curves, const PlannedScenes& scenes,
                                       std::size_t count)
{
    const auto& requests = curves.requests();
    const auto plan = analysis::make_plan(requests, analysis::camera_slots(requests));
    analysis::UnitDivision division = analysis::divide_into_units(
        plan, requests, count == 0 ? analysis::default_unit_count(plan, requests) : count);
    analysis::keep_equals_together(curves, scenes.identities(), division.unit_of);
    const std::size_t divided = division.seconds.size();
    std::vector<std::set<std::string>> hashes(divided);
    for (std::size_t i = 0; i < requests.size(); ++i) {
        hashes[division.unit_of[i] - 1].insert(scenes.hash(i));
    }
    const auto ordinals = analysis::ordinals_of_units(curves, division.unit_of, divided);
    std::vector<PlannedUnit> units;
    for (std::size_t i = 0; i < divided; ++i) {
        if (!ordinals[i].empty()) {
            PlannedUnit& unit = units.emplace_back();
            unit.seconds = division.seconds[i];
            unit.configurations = ordinals[i].size();
            unit.scenes.assign(hashes[i].begin(), hashes[i].end());
            unit.ordinals = analysis::ordinal_runs(ordinals[i]);
        }
    }
    return units;
}

namespace fs = std::filesystem;
using store::PlannedScene;
using store::UnitPlan;

/// An environment error: the scene was valid when it was packed.
[[noreturn]] void throw_damaged(const fs::path& packed)
{
    throw scene::EnvironmentError(scene::one_line(
        fmt::format("{}: the packed scene is damaged, or of another version: remove it, and copy "
                    "it again",
                    packed.string())));
}

/// @throws scene::EnvironmentError  if it cannot be read.
std::vector<std::byte> bytes_of(const fs::path& path)
{
    std::error_code error;
    const auto size = fs::file_size(path, error);
    std::ifstream file{path, std::ios::binary};
    std::vector<std::byte> bytes(error ? 0 : size);
    if (error || !file.read(reinterpret_cast<char*>(bytes.data()),
                            static_cast<std::streamsize>(bytes.size()))) {
        throw_damaged(path);
    }
    return bytes;
}

/// Other scenes are built in, and need no packing.
bool is_scene_of_file(const PlannedScene& scene)
{
    return scene.keys.find("scene.file") != std::string::npos;
}

bool is_packed(const fs::path& folder, const PlannedScene& scene)
{
    std::error_code error;
    return !folder.empty() && fs::exists(packed_scene_path(folder, scene), error);
}

} // namespace

JobOptions options_of(const store::PlannedJob& job)
{
    return {job.path, job.builtin, job.preset, job.settings, job.case_name, job.light};
}

scene::SweepSpace space_of(const store::PlannedJob& job)
{
    return {job_source_of_text(options_of(job), job.text), job.axes, job.case_name};
}

PlannedScene planned_scene(std::string name, std::string keys, const api::SceneContent& content)
{
    // A job without camera and light takes both from the file.
    const auto taken = analysis::identify_scene({}, content.hash, content.defaults);
    scene::Fnv1a brought;
    brought.add(taken.taken_keys);
    brought.add(content.normals);
    return {std::move(name), std::move(keys), content.hash,
            fmt::format("{:016x}", brought.value())};
}

UnitPlan plan_sweep(const JobOptions& options, const std::vector<std::string>& axes,
                    std::size_t count, const std::filesystem::path& scenes)
{
    if (!options.job_path.empty()) {
        require_job_of_gl(options);
    }
    UnitPlan plan;
    plan.gnomon = GNOMON_VERSION;
    plan.directory = std::filesystem::current_path();
    plan.job = planned_job(options, axes);
    plan.command = command_text("sweep", options, axes);
    plan.compare_command = command_text("compare", options);
    const scene::SweepSpace space = space_of(plan.job);
    plan.size = space.size();
    const SweepCurves curves{space, false, GNOMON_VERSION};
    if (curves.requests().empty()) {
        throw scene::InputError(curves.refusals().front().message);
    }
    const PlannedScenes planned{curves, scenes};
    plan.keeps_normals = planned.normals() == scene::VertexNormals::kept;
    plan.scenes = planned.scenes();
    plan.units = planned_units(curves, planned, count);
    store::complete_plan(plan);
    return plan;
}

fs::path packed_scene_path(const fs::path& folder, const PlannedScene& scene)
{
    return folder / fmt::format("{}-{}.scene", scene.hash, scene.brought);
}

bool has_packed_scenes(const fs::path& folder, const UnitPlan& plan, const store::PlannedUnit& unit)
{
    return std::ranges::all_of(plan.scenes, [&](const PlannedScene& scene) {
        return !is_scene_of_file(scene) ||
               std::ranges::find(unit.scenes, scene.hash) == unit.scenes.end() ||
               is_packed(folder, scene);
    });
}

scene::SceneFile load_planned_scene(const fs::path& folder, const UnitPlan& plan,
                                    const scene::Job& job, scene::VertexNormals normals)
{
    const auto planned =
        std::ranges::find(plan.scenes, analysis::stage_keys(job).scene, &PlannedScene::keys);
    if (planned == plan.scenes.end() || !is_packed(folder, *planned)) {
        return scene::load_scene(job.scene, normals);
    }
    const fs::path packed = packed_scene_path(folder, *planned);
    try {
        return scene::load_packed_scene(job.scene, bytes_of(packed), normals);
    } catch (const scene::InputError&) {
        throw_damaged(packed);
    }
}

} // namespace gnomon::cli
