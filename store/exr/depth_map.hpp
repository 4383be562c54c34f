#pragma once

#include "analysis/comparison.hpp"
#include "scene/image.hpp"

#include <filesystem>

namespace gnomon::store {

/// Writes a comparison's shadow map into an EXR file, with the header of `write_aov`.
///
/// float32: `depth` as shaders see it, in [0, 1], and `light_distance_m`, the distance from the
/// light's camera plane that it stands for [m], NaN where nothing was drawn.
/// @param depths  Of the job's shadow map, top left first, square.
/// @throws std::invalid_argument    if `depths` is not of the map's size.
/// @throws scene::EnvironmentError  if the file cannot be written; what stood there then stays.
void write_depth_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                     const scene::Image<float>& depths);

} // namespace gnomon::store
