#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::scene {

/// What a scene file holds beside triangles: plain numbers, as the importing child counts them.
struct ContentCounts {
    std::uint64_t cameras = 0; ///< that stand in its scene
    std::uint64_t lights = 0;
    std::uint64_t masked_materials = 0; ///< whose alpha cuts holes; of those that objects have
    std::uint64_t masked_objects = 0;
    std::uint64_t blended_materials = 0; ///< that light shines through; likewise
    std::uint64_t blended_objects = 0;
    std::uint64_t clear_materials = 0; ///< of masked and blended ones, those with a base alpha of 0
    /// Whose vertices have an alpha below 1 where no material says what that does, as in PLY.
    std::uint64_t vertex_alpha_objects = 0;
    std::uint64_t skinned_objects = 0;
    std::uint64_t morphed_objects = 0;
    std::uint64_t animations = 0;
    std::uint64_t free_form_shapes = 0; ///< curves and surfaces of an OBJ file
};

struct FileContents {
    ContentCounts counts;
    std::vector<std::string> unread_extensions; ///< of glTF, that the file can do without
};

} // namespace gnomon::scene
