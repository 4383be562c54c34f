#pragma once

#include "scene/geometry/file_contents.hpp"

#include <cstdint>
#include <set>

struct aiMesh;
struct aiScene;

namespace gnomon::scene {

/// Counts what of the placed meshes' surfaces the renderers do not follow: transparency, and what
/// would bend them.
class SurfaceCounter {
public:
    /// @param scene  must outlive this.
    explicit SurfaceCounter(const aiScene& scene) : scene_{&scene} {}

    /// One object of this mesh.
    void add(const aiMesh& mesh);
    void write(ContentCounts& counts) const;

private:
    const aiScene* scene_;
    ContentCounts objects_;
    std::set<unsigned> masked_; ///< materials by number
    std::set<unsigned> blended_;
    std::set<unsigned> clear_;
};

} // namespace gnomon::scene
