#pragma once

#include "methods/method.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/file.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The method that a job names, and what it says of the job.
namespace gnomon::methods {

/// The method of that name, or nullptr.
[[nodiscard]] const Method* find_method(std::string_view name);

/// The job's method.
/// @throws std::invalid_argument  if no method has its name.
[[nodiscard]] const Method& method_of(const scene::Job& job);

/// What the job's method promises of its lookups.
[[nodiscard]] LookupTraits traits(const scene::Job& job);

/// @throws scene::InputError  if the settings of the job's method do not go together.
void check(const scene::Job& job);

/// What GL is to do for the job.
[[nodiscard]] Passes passes(const scene::Job& job);

/// The bias terms of the job's method that act on its lookups, in the order of its list.
[[nodiscard]] std::vector<ActiveBias> active_biases(const scene::Job& job, const scene::View& view);

/// Whether other biases act than the curve's formula has: then the lookup is not at the receiver
/// itself, or in a map that a bias was drawn into, and the one without bias does not follow from
/// it.
[[nodiscard]] bool moves_lookups(const scene::Job& job, const scene::View& view);

/// What the job's maps are drawn with; nothing where no bias term acts there.
[[nodiscard]] std::optional<PolygonOffset> map_offset(const scene::Job& job,
                                                      const scene::View& view);

/// How far along the normal the job's biases move the lookup of a receiver at ζ in one of the maps
/// [m]; empty where one of them moves it otherwise.
[[nodiscard]] std::optional<double> normal_offset_m(const scene::Job& job, const scene::View& view,
                                                    std::size_t map, double light_distance_m);

/// Whether a scene is to be loaded with normals of its vertices for the job: a bias term of its
/// method reads them.
[[nodiscard]] scene::VertexNormals vertex_normals(const scene::Job& job);

/// The same for several jobs: kept where one of them needs them.
[[nodiscard]] scene::VertexNormals vertex_normals(std::span<const scene::LightJob> jobs);

/// The keys of those biases, of the job's method: at their defaults they do not act.
[[nodiscard]] std::vector<std::string_view> moving_bias_keys(const scene::Job& job);

} // namespace gnomon::methods
