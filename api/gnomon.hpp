#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/advice.hpp"
#include "api/array_scene.hpp"
#include "api/compare.hpp"
#include "api/mask.hpp"
#include "api/scene.hpp"
#include "api/sweep/sweep.hpp"
#include "api/tune.hpp"
#include "reports/json/comparison_json.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/light/light.hpp"
#include "scene/light/sun.hpp"
#include "scene/pixels/given_points.hpp"
#include "scene/vec.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Gnomon as a library: `load`, `truth`, `compare`, `evaluate` and `sweep`, as the program and
/// Python have them (docs/c.md).
namespace gnomon::api {

/// Keys of a job over what it says: {"bias.constant", "0.001"}, values in TOML.
using JobKeys = std::vector<scene::Override>;

/// A scene file, or the scene of a job file.
/// @param keys  of [scene].
/// @throws scene::InputError  if the file cannot be read, or a key is unknown or out of its range.
[[nodiscard]] std::shared_ptr<const Scene> load(const std::filesystem::path& path,
                                                const JobKeys& keys = {});

/// Whether each point sees the light: points in space, or on triangles of the scene.
/// @param threads  0: all cores.
/// @throws scene::InputError  naming the point, as `reference_rt::find_point_truth` does.
[[nodiscard]] scene::PointTruth truth(const Scene& scene, std::span<const scene::Vec3d> points,
                                      const scene::Light& light, int threads = 0);
[[nodiscard]] scene::PointTruth truth(const Scene& scene, const scene::SurfacePoints& points,
                                      const scene::Light& light, int threads = 0);

/// The comparisons of a job's lights, and the scene that they refer to.
struct ComparedJob {
    std::unique_ptr<const ComparisonSession> session;
    std::vector<analysis::Comparison> lights; ///< in the order of the job
};

/// Draws a job's shadow map with GL, and holds every pixel to the truth.
/// @param job  a job file, a scene file, or the name of a built-in scene.
/// @throws scene::InputError        if the job is bad.
/// @throws scene::EnvironmentError  if there is no GL driver, or GL or Embree fails.
[[nodiscard]] ComparedJob compare(const std::string& job, const JobKeys& keys = {},
                                  const SessionOptions& options = {});

/// Computes many configurations into a run, or what it lacks.
/// @param axes     "bias.constant=[0, 0.001]", beside those of the job's own [sweep].
/// @param options  its folder is the run's.
/// @throws scene::InputError, scene::EnvironmentError  as `api::sweep` of a `SweepSpace` does.
[[nodiscard]] SweepOutcome sweep(const std::string& job, const std::vector<std::string>& axes,
                                 SweepRunOptions options, const JobKeys& keys = {});

} // namespace gnomon::api
