#pragma once

#include "scene/vec.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// What a scene file holds besides triangles, as counted by the importing child process.
struct ContentCounts {
    std::uint64_t cameras = 0; ///< placed in its scene
    std::uint64_t lights = 0;
    std::uint64_t masked_materials = 0; ///< used materials whose alpha cuts holes
    std::uint64_t masked_objects = 0;
    std::uint64_t blended_materials = 0; ///< used materials that are translucent
    std::uint64_t blended_objects = 0;
    std::uint64_t clear_materials = 0; ///< masked or blended, with a base alpha of 0
    /// Objects with vertex alpha below 1 but no material that gives it a meaning, as in PLY.
    std::uint64_t vertex_alpha_objects = 0;
    std::uint64_t skinned_objects = 0;
    std::uint64_t morphed_objects = 0;
    std::uint64_t animations = 0;
    std::uint64_t free_form_shapes = 0; ///< curves and surfaces of an OBJ file
};

struct FileContents {
    ContentCounts counts;
    std::vector<std::string> unread_extensions; ///< optional glTF extensions that are not supported
};

/// "No triangle": a primitive buffer's value where nothing was drawn.
inline constexpr std::uint32_t no_triangle = 0xFFFFFFFF;
/// The largest coordinate allowed: Embree silently drops triangles past 1.8e18.
inline constexpr double max_coordinate_m = 1e15;

/// Axis-aligned box [m]; empty when `lower.x > upper.x`.
struct Box {
    Vec3d lower;
    Vec3d upper;

    [[nodiscard]] Vec3d centre() const { return 0.5 * (lower + upper); }
    /// Length of the space diagonal [m].
    [[nodiscard]] double diagonal_m() const;
    /// x varies fastest, then y, then z; lower before upper.
    [[nodiscard]] std::array<Vec3d, 8> corners() const;
};

/// A named run of triangles, [first_triangle, first_triangle + triangle_count).
struct Object {
    std::string name;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    bool casts = true;                ///< drawn to the shadow map, and part of the shadow truth
    bool receives = true;             ///< drawn to the camera
    std::uint32_t flat_triangles = 0; ///< dropped because they have zero area
};

/// Attributes of a triangle's corner. Triangles that share a vertex each have their own.
struct CornerAttributes {
    Vec3f normal; ///< unit, from the file; 0: none

    friend bool operator==(const CornerAttributes&, const CornerAttributes&) = default;
};
using TriangleAttributes = std::array<CornerAttributes, 3>;

/// The scene that both renderers see: world-space float32 triangles. The truth depends on nothing
/// else.
///
/// Vertices are shared through `triangles` only to save work; two vertices are the same point when
/// their coordinates are bit-equal. Every coordinate is finite, within ±1e15, not subnormal and not
/// negative zero; every vertex is used; no triangle has zero area. Objects are contiguous, in
/// order, and cover every triangle.
struct TriangleScene {
    std::vector<Vec3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Object> objects;
    /// Of each triangle's corners; empty unless normals are kept
    /// (scene/geometry/vertex_normals.hpp). Only lookups that are offset along normals read them.
    std::vector<TriangleAttributes> attributes;
    std::uint64_t dropped_triangles = 0;  ///< zero-area triangles that were removed
    std::uint64_t ignored_primitives = 0; ///< points and lines that the file held
    FileContents file;                    ///< what else the file held; empty for a built-in scene

    [[nodiscard]] std::array<Vec3f, 3> corners(std::uint32_t triangle) const
    {
        const auto& t = triangles[triangle];
        return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }
    /// Index into `objects` of the object that holds `triangle`.
    [[nodiscard]] std::size_t object_of(std::uint32_t triangle) const;
    /// Box of all vertices. @throws InputError if the scene has no triangle.
    [[nodiscard]] Box bounds() const;
};

/// A run of consecutive triangles.
struct TriangleRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};
/// The triangles of casting objects, as few ranges as possible, in order.
[[nodiscard]] std::vector<TriangleRange> casting_ranges(const TriangleScene& scene);
/// The triangles of receiving objects, as few ranges as possible, in order.
[[nodiscard]] std::vector<TriangleRange> receiving_ranges(const TriangleScene& scene);

/// Adds meshes in double precision and produces the float32 scene that both renderers see.
///
/// Each vertex is rounded to float32 once; subnormals become zero; triangles whose rounded corners
/// span exactly zero area are dropped and counted.
class SceneBuilder {
public:
    /// Appends one object. An empty mesh adds nothing.
    /// @param vertices    World-space corners [m].
    /// @param triangles   Indices into `vertices`, counter-clockwise seen from outside.
    /// @param attributes  Of each triangle's corners; may be empty.
    /// @throws InputError  naming object and vertex, if a coordinate is not finite or beyond 1e15,
    ///                     or if an index is out of range, or if there are 2^32 - 1 triangles.
    /// @throws std::invalid_argument  if only some triangles have attributes.
    /// @return  Indices of the triangles that were kept, ascending.
    std::vector<std::uint32_t> add(std::string_view name, std::span<const Vec3d> vertices,
                                   std::span<const std::array<std::uint32_t, 3>> triangles,
                                   std::span<const TriangleAttributes> attributes = {});
    /// Counts points and lines of a file that are not part of the scene.
    void count_ignored_primitives(std::uint64_t count) { scene_.ignored_primitives += count; }
    /// Records what else the file held.
    void keep_contents(FileContents contents) { scene_.file = std::move(contents); }
    /// The scene built so far; leaves the builder empty.
    [[nodiscard]] TriangleScene take();

private:
    TriangleScene scene_;
};

/// Adds a square "ground" of two triangles under the box, at its lowest y; its half side is one
/// and a half diagonals of the box.
void add_ground(TriangleScene& scene);

/// Marks the named objects as not casting or not receiving.
/// @throws InputError  naming the nearest object, if a name matches no object.
void set_roles(TriangleScene& scene, std::span<const std::string> no_cast,
               std::span<const std::string> no_receive);

/// A 64-bit FNV-1a hash of vertices, indices, object names and roles, as 16 hexadecimal digits.
/// Covers everything that the truth depends on, so not the normals.
[[nodiscard]] std::string content_hash(const TriangleScene& scene);

} // namespace gnomon::scene
