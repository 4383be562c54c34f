#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/advice.hpp"
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

/// Gnomon as a library: `load`, `truth`, `compare`, `evaluate` and `sweep`, as in the program and
/// in Python (docs/c.md).
namespace gnomon::api {

/// Keys that override a job's, with values in TOML: {"bias.constant", "0.001"}.
using JobKeys = std::vector<scene::Override>;

/// Loads a scene file, or the scene of a job file.
/// @param keys  keys of [scene].
/// @throws scene::InputError  if the file cannot be read, or a key is unknown or out of range.
[[nodiscard]] std::shared_ptr<const Scene> load(const std::filesystem::path& path,
                                                const JobKeys& keys = {});

/// Whether each point sees the light. Points lie in space, or on triangles of the scene.
/// @param threads  0 for all cores.
/// @throws scene::InputError  naming the point, as `reference_rt::find_point_truth`.
[[nodiscard]] scene::PointTruth truth(const Scene& scene, std::span<const scene::Vec3d> points,
                                      const scene::Light& light, int threads = 0);
[[nodiscard]] scene::PointTruth truth(const Scene& scene, const scene::SurfacePoints& points,
                                      const scene::Light& light, int threads = 0);

/// The comparison of each of a job's lights, and the scene that they refer to.
struct ComparedJob {
    std::unique_ptr<const ComparisonSession> session;
    std::vector<analysis::Comparison> lights; ///< in the job's order
};

/// Draws a job's shadow map with GL, and compares every pixel with the truth.
/// @param job  a job file, a scene file, or the name of a built-in scene.
/// @throws scene::InputError        if the job is invalid.
/// @throws scene::EnvironmentError  if there is no GL driver, or GL or Embree fails.
[[nodiscard]] ComparedJob compare(const std::string& job, const JobKeys& keys = {},
                                  const SessionOptions& options = {});

/// Computes the configurations of a sweep that its run still lacks.
/// @param axes     "bias.constant=[0, 0.001]", in addition to the job's [sweep].
/// @param options  `folder` is the run's.
/// @throws scene::InputError, scene::EnvironmentError  as `api::sweep` of a `SweepSpace`.
[[nodiscard]] SweepOutcome sweep(const std::string& job, const std::vector<std::string>& axes,
                                 SweepRunOptions options, const JobKeys& keys = {});

} // namespace gnomon::api
