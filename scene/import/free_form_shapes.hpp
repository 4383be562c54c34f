#pragma once

#include <cstdint>
#include <filesystem>

namespace gnomon::scene {

/// How many curves and surfaces an OBJ file holds beside its polygons: Assimp passes them over.
[[nodiscard]] std::uint64_t count_free_form_shapes(const std::filesystem::path& obj_file);

} // namespace gnomon::scene
