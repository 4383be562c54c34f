#pragma once

#include "scene/geometry/triangles.hpp"

#include <cstdint>
#include <filesystem>
#include <set>

struct aiMesh;
struct aiScene;

namespace gnomon::scene {

/// Counts surface features that the renderers ignore: transparency, skins and morph targets.
class SurfaceCounter {
public:
    /// @param scene  must outlive this.
    explicit SurfaceCounter(const aiScene& scene) : scene_{&scene} {}

    /// Adds one object with this mesh.
    void add(const aiMesh& mesh);
    void write(ContentCounts& counts) const;

private:
    const aiScene* scene_;
    ContentCounts objects_;
    std::set<unsigned> masked_; ///< materials by number
    std::set<unsigned> blended_;
    std::set<unsigned> clear_;
};

/// Counts the curves and free-form surfaces of an OBJ file, which Assimp ignores.
[[nodiscard]] std::uint64_t count_free_form_shapes(const std::filesystem::path& obj_file);

} // namespace gnomon::scene
