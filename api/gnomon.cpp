#include "api/gnomon.hpp"

#include "methods/key_table.hpp"
#include "reference_rt/points/point_truth.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::api {
namespace {

scene::JobSource source_of(const std::string& job, const JobKeys& keys)
{
    const scene::Keys& table = methods::key_table();
    const auto builtins = scene::builtin_scenes();
    const bool is_builtin =
        std::ranges::find(builtins, job, &scene::BuiltinScene::name) != builtins.end();
    return is_builtin && !std::filesystem::exists(job)
               ? scene::builtin_job_source(job, keys, {}, table)
               : scene::read_job_source(job, keys, {}, table);
}

} // namespace

std::shared_ptr<const Scene> load(const std::filesystem::path& path, const JobKeys& keys)
{
    return std::make_shared<const Scene>(
        scene::read_job(path, keys, {}, methods::key_table()).job.scene);
}

scene::PointTruth truth(const Scene& scene, std::span<const scene::Vec3d> points,
                        const scene::Light& light, int threads)
{
    return reference_rt::find_point_truth(scene.reference(), light, points, {threads, {}});
}

scene::PointTruth truth(const Scene& scene, const scene::SurfacePoints& points,
                        const scene::Light& light, int threads)
{
    return reference_rt::find_point_truth(scene.reference(), light, points, {threads, {}});
}

ComparedJob compare(const std::string& job, const JobKeys& keys, const SessionOptions& options)
{
    const auto lights = scene::light_jobs(source_of(job, keys));
    ComparedJob compared{std::make_unique<const ComparisonSession>(lights, options), {}};
    compared.lights = compare(*compared.session, lights);
    return compared;
}

SweepOutcome sweep(const std::string& job, const std::vector<std::string>& axes,
                   SweepRunOptions options, const JobKeys& keys)
{
    return sweep(scene::SweepSpace{source_of(job, keys), axes}, options);
}

} // namespace gnomon::api
