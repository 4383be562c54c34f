#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/vec.hpp"

#include <filesystem>
#include <span>

namespace gnomon::store {

/// Writes every layer of a comparison into one EXR file, channels by name.
///
/// float32: `truth` (1 lit, 0 blocked, −1 not scored), `verdict`, `P.X P.Y P.Z` [m],
/// `receiver_depth`, `map_depth` (NaN where the border mode decided); uint32: `class` (the values
/// of scene::PixelClass), `prim` and `witness` (0xFFFFFFFF for none). The header holds the exact
/// inputs as `gnomon:eye` … in hexadecimal, and the job as JSON in `gnomon:job`.
/// @param points  P of each pixel [m], NaN where there is no receiver.
/// @throws std::invalid_argument    if `points` is not of the image's size.
/// @throws scene::EnvironmentError  if the file cannot be written; what stood there then stays.
void write_aov(const std::filesystem::path& path, const analysis::Comparison& comparison,
               const scene::Image<scene::Vec3f>& points);

/// The same of a job's several lights: the channels of each as `NAME.truth` and so on.
/// @param lights  at least one; the camera, and so P, is the same of all.
void write_aov(const std::filesystem::path& path, std::span<const analysis::Comparison> lights,
               const scene::Image<scene::Vec3f>& points);

} // namespace gnomon::store
