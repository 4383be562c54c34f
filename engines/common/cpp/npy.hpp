#pragma once

#include <filesystem>
#include <vector>

namespace engine {

/// Writes numbers as NumPy's .npy: float32, little-endian, of the shape (height, width, count), or
/// (height, width) for one number a pixel.
/// @param values  count numbers a pixel; the rows come in the file's order.
/// @throws std::runtime_error  if the file cannot be written.
void write_npy(const std::filesystem::path& file, const std::vector<float>& values, int width,
               int height, int count);

} // namespace engine
