#pragma once

#include "renderers/light_queries.hpp"

#include <memory>
#include <vector>

namespace gnomon::reference_rt {

/// Answers about all maps of a light, from answers about each: a question goes to the map that its
/// texel is of, or that its pixel reads. Blockers are the first's to find, for light distances are
/// those of all maps.
/// @param maps  by index; one is returned as it is.
/// @throws std::invalid_argument  if there is none, or more than `most_maps`; the answers throw it
/// for a map that is not
///                                there.
[[nodiscard]] std::unique_ptr<renderers::LightQueries>
shadow_map_rays(std::vector<std::unique_ptr<renderers::LightQueries>> maps);

} // namespace gnomon::reference_rt
