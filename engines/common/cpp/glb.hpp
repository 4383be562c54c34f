#pragma once

#include <string>
#include <vector>

namespace engine {

/// An object of a mesh file.
struct GlbObject {
    std::string name;
    std::vector<float> corners; ///< three corners of three numbers a triangle, world space [m]
};

/// The objects of a mesh file as the protocol has it: positions and indices, no transforms.
/// @throws std::runtime_error  if the file cannot be read, or is no such file.
[[nodiscard]] std::vector<GlbObject> read_glb(const std::string& file);

} // namespace engine
