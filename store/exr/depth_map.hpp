#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/image.hpp"

#include <filesystem>

namespace gnomon::store {

/// Writes a comparison's shadow map into an EXR file, with the header of `write_aov`; of several
/// maps each into a part of that map's name.
///
/// float32: `depth` as shaders see it, in [0, 1], and `light_distance_m`, the distance from the
/// light's camera plane, or of a map of distances from the light, that it stands for [m], NaN where
/// nothing was drawn.
/// @param depths  Of the view's maps, top left first (`scene::maps_image_size`).
/// @throws std::invalid_argument    if `depths` is not of their size.
/// @throws scene::EnvironmentError  if the file cannot be written; what stood there then stays.
void write_depth_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                     const scene::Image<float>& depths);

} // namespace gnomon::store
