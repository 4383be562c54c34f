#pragma once

#include "methods/method.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/file.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Queries about a job's method.
namespace gnomon::methods {

/// The method of that name, or nullptr.
[[nodiscard]] const Method* find_method(std::string_view name);

/// The job's method.
/// @throws std::invalid_argument  if no method has its name.
[[nodiscard]] const Method& method_of(const scene::Job& job);

/// The traits of the job's lookups.
[[nodiscard]] LookupTraits traits(const scene::Job& job);

/// @throws scene::InputError  if the settings of the job's method are incompatible.
void check(const scene::Job& job);

/// The GL passes of the job.
[[nodiscard]] Passes passes(const scene::Job& job);

/// The bias terms that act on the job's lookups, in the order of its method's list.
[[nodiscard]] std::vector<ActiveBias> active_biases(const scene::Job& job, const scene::View& view);

/// Whether biases act that are not part of the curve's formula. Then the lookup is not at the
/// receiver itself, or the map was drawn with a bias, so the unbiased lookup does not follow from
/// it.
[[nodiscard]] bool moves_lookups(const scene::Job& job, const scene::View& view);

/// The polygon offset of the job's maps; empty if no bias term sets one.
[[nodiscard]] std::optional<PolygonOffset> map_offset(const scene::Job& job,
                                                      const scene::View& view);

/// Distance along the normal by which the job's biases move the lookup of a receiver at ζ in a map
/// [m]; empty if one of them moves it in another way.
[[nodiscard]] std::optional<double> normal_offset_m(const scene::Job& job, const scene::View& view,
                                                    std::size_t map, double light_distance_m);

/// Whether the job's scene must keep vertex normals, because a bias term reads them.
[[nodiscard]] scene::VertexNormals vertex_normals(const scene::Job& job);

/// As above, for several jobs: kept if one of them needs them.
[[nodiscard]] scene::VertexNormals vertex_normals(std::span<const scene::LightJob> jobs);

/// The keys of the biases in `moves_lookups`; at their defaults they do not act.
[[nodiscard]] std::vector<std::string_view> moving_bias_keys(const scene::Job& job);

} // namespace gnomon::methods
