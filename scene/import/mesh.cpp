#include "scene/import/mesh.hpp"

#include "scene/import/gltf_facts.hpp"

#include <assimp/mesh.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace gnomon::scene {
namespace {

/// A corner of the polygon, projected so that the polygon turns counter-clockwise.
struct ProjectedCorner {
    std::uint32_t index = 0;
    Vec2d position;
};

double twice_area(const ProjectedCorner& a, const ProjectedCorner& b, const ProjectedCorner& c)
{
    const Vec2d ab = b.position - a.position;
    const Vec2d ac = c.position - a.position;
    return ab.x * ac.y - ab.y * ac.x;
}

/// Newell's normal: twice the area of the polygon's shadow on each coordinate plane.
Vec3d area_vector(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon)
{
    const Vec3d origin{vertices[polygon[0]]};
    Vec3d sum{0};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += glm::cross(Vec3d{vertices[polygon[i]]} - origin,
                          Vec3d{vertices[polygon[i + 1]]} - origin);
    }
    return sum;
}

std::vector<ProjectedCorner> projected(std::span<const Vec3f> vertices,
                                       std::span<const std::uint32_t> polygon)
{
    const Vec3d area = area_vector(vertices, polygon);
    const Vec3d size = glm::abs(area);
    const int dropped = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int first = (dropped + 1) % 3;
    int second = (dropped + 2) % 3;
    if (area[dropped] < 0) {
        std::swap(first, second);
    }
    std::vector<ProjectedCorner> corners;
    corners.reserve(polygon.size());
    for (const std::uint32_t index : polygon) {
        const Vec3d position{vertices[index]};
        corners.push_back({index, {position[first], position[second]}});
    }
    return corners;
}

/// The remaining corners, as a ring.
///
/// An ear is a convex corner whose triangle holds no other corner. In a simple polygon only
/// non-convex corners can be such obstacles, and in large polygons only those are tested. Each
/// corner remembers its obstacle: it is no ear while the obstacle and both neighbours remain.
class CornerRing {
public:
    explicit CornerRing(std::vector<ProjectedCorner> corners)
        : corners_{std::move(corners)},
          next_(corners_.size()),
          previous_(corners_.size()),
          obstacle_(corners_.size(), unknown),
          obstacle_place_(corners_.size(), none)
    {
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            next_[i] = i + 1 < corners_.size() ? i + 1 : 0;
            previous_[i] = i > 0 ? i - 1 : static_cast<std::uint32_t>(corners_.size() - 1);
        }
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            sort_in(i);
        }
    }

    [[nodiscard]] std::size_t size() const { return corners_.size() - cut_count_; }
    [[nodiscard]] std::uint32_t first() const { return first_; }
    [[nodiscard]] std::uint32_t after(std::uint32_t i) const { return next_[i]; }
    [[nodiscard]] TriangleIndices triangle_at(std::uint32_t i) const
    {
        return {corners_[previous_[i]].index, corners_[i].index, corners_[next_[i]].index};
    }

    /// The corner to cut off next. Flat corners come last, because their neighbours may need them.
    [[nodiscard]] std::uint32_t next_cut()
    {
        std::uint32_t i = first_;
        do {
            i = next_[i];
            if (is_ear(i)) {
                return i;
            }
        } while (i != first_);
        do {
            i = next_[i];
            if (turn_at(i) == 0) {
                return i;
            }
        } while (i != first_);
        return next_[first_];
    }

    void cut(std::uint32_t i)
    {
        const std::uint32_t before = previous_[i];
        const std::uint32_t after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        first_ = first_ == i ? after : first_;
        ++cut_count_;
        previous_[i] = none;
        leave_out(i);
        for (const std::uint32_t neighbour : {before, after}) {
            obstacle_[neighbour] = unknown;
            sort_in(neighbour);
        }
    }

private:
    /// Largest polygon in which every corner is tested.
    static constexpr std::size_t most_looked_at = 16'384;
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    static constexpr std::uint32_t unknown = none - 1;
    static constexpr std::uint32_t itself = none - 2; ///< it is not convex

    [[nodiscard]] double turn_at(std::uint32_t i) const
    {
        return twice_area(corners_[previous_[i]], corners_[i], corners_[next_[i]]);
    }

    [[nodiscard]] bool is_ear(std::uint32_t i)
    {
        const std::uint32_t known = obstacle_[i];
        if (known == none) {
            return true;
        }
        if (known == itself || (known != unknown && previous_[known] != none)) {
            return false;
        }
        obstacle_[i] = turn_at(i) > 0 ? find_obstacle(i) : itself;
        return obstacle_[i] == none;
    }

    /// A corner inside the triangle that cutting `i` removes, or `none`.
    [[nodiscard]] std::uint32_t find_obstacle(std::uint32_t i) const
    {
        const ProjectedCorner& a = corners_[previous_[i]];
        const ProjectedCorner& b = corners_[i];
        const ProjectedCorner& c = corners_[next_[i]];
        const Vec2d lower = glm::min(glm::min(a.position, b.position), c.position);
        const Vec2d upper = glm::max(glm::max(a.position, b.position), c.position);
        for (const Obstacle& other : obstacles_) {
            const Vec2d& p = other.corner.position;
            if (p.x < lower.x || p.x > upper.x || p.y < lower.y || p.y > upper.y) {
                continue;
            }
            // Polygons with holes pass twice through the ends of the bridge.
            const bool is_corner = p == a.position || p == b.position || p == c.position;
            if (!is_corner && twice_area(a, b, other.corner) >= 0 &&
                twice_area(b, c, other.corner) >= 0 && twice_area(c, a, other.corner) >= 0) {
                return other.place;
            }
        }
        return none;
    }

    /// Adds a corner to the obstacles or removes it.
    void sort_in(std::uint32_t i)
    {
        const bool is_in_the_way = corners_.size() <= most_looked_at || !(turn_at(i) > 0);
        if (is_in_the_way && obstacle_place_[i] == none) {
            obstacle_place_[i] = static_cast<std::uint32_t>(obstacles_.size());
            obstacles_.push_back({corners_[i], i});
        } else if (!is_in_the_way) {
            leave_out(i);
        }
    }

    void leave_out(std::uint32_t i)
    {
        if (obstacle_place_[i] != none) {
            obstacles_[obstacle_place_[i]] = obstacles_.back();
            obstacle_place_[obstacles_.back().place] = obstacle_place_[i];
            obstacles_.pop_back();
            obstacle_place_[i] = none;
        }
    }

    struct Obstacle {
        ProjectedCorner corner;
        std::uint32_t place = 0;
    };

    std::vector<ProjectedCorner> corners_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_; ///< `none`: cut off
    std::vector<std::uint32_t> obstacle_; ///< `none`: an ear
    std::vector<Obstacle> obstacles_;     ///< in any order
    std::vector<std::uint32_t> obstacle_place_;
    std::uint32_t first_ = 0;
    std::size_t cut_count_ = 0;
};

} // namespace

void triangulate(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon,
                 std::vector<TriangleIndices>& triangles)
{
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return;
    }
    CornerRing corners{projected(vertices, polygon)};
    while (corners.size() > 3) {
        const std::uint32_t i = corners.next_cut();
        triangles.push_back(corners.triangle_at(i));
        corners.cut(i);
    }
    triangles.push_back(corners.triangle_at(corners.after(corners.first())));
}

namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits position_bits(const Vec3f& position)
{
    return {std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
            std::bit_cast<std::uint32_t>(position.z)};
}

std::uint64_t hash(const PositionBits& bits)
{
    std::uint64_t value = 0;
    for (const std::uint32_t word : bits) {
        value = (value ^ word) * 0x9E3779B97F4A7C15ULL;
        value ^= value >> 32U;
    }
    return value;
}

/// Gives bit-equal positions the same index, in the order in which they first appear.
class VertexTable {
public:
    VertexTable(std::vector<Vec3f>& vertices, std::size_t capacity)
        : vertices_{vertices},
          slots_(std::bit_ceil(2 * capacity + 1), empty)
    {
    }
    std::uint32_t index_of(const Vec3f& position)
    {
        const PositionBits bits = position_bits(position);
        std::size_t slot = hash(bits) & (slots_.size() - 1);
        while (slots_[slot] != empty && position_bits(vertices_[slots_[slot]]) != bits) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        if (slots_[slot] == empty) {
            slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(position);
        }
        return slots_[slot];
    }

private:
    static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();
    std::vector<Vec3f>& vertices_;
    std::vector<std::uint32_t> slots_;
};

/// @throws std::runtime_error  naming mesh and face, if a face uses a vertex that is not there.
void check_indices(const aiMesh& mesh)
{
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices) {
                throw std::runtime_error{
                    fmt::format("mesh \"{}\", face {}: vertex index {} of {} vertices",
                                mesh.mName.C_Str(), f, face.mIndices[k], mesh.mNumVertices)};
            }
        }
    }
}

/// Of a polygon. Triangulation takes time quadratic in this number.
constexpr unsigned most_corners = 100'000;

/// @throws UnsupportedContent  naming mesh and face, if a polygon is too large.
void check_corners(const aiMesh& mesh)
{
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const unsigned corners = mesh.mFaces[f].mNumIndices;
        if (corners > most_corners) {
            throw UnsupportedContent{
                fmt::format("mesh \"{}\", face {}: a polygon of {} corners is too large, at most "
                            "{} are supported; export it as triangles",
                            mesh.mName.C_Str(), f, corners, most_corners)};
        }
    }
}

/// Finds the corner attributes of a face's triangles after its vertices were merged.
class FaceAttributes {
public:
    FaceAttributes(const aiMesh& mesh, std::size_t vertex_count)
        : mesh_{mesh},
          source_of_(vertex_count)
    {
    }

    /// @param polygon    the merged vertices of the face's corners, in order.
    /// @param triangles  of the triangulated face.
    void append(const aiFace& face, std::span<const std::uint32_t> polygon,
                std::span<const TriangleIndices> triangles,
                std::vector<TriangleAttributes>& attributes)
    {
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            source_of_[polygon[k]] = face.mIndices[k];
        }
        for (const TriangleIndices& triangle : triangles) {
            TriangleAttributes& corners = attributes.emplace_back();
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const aiVector3D& n = mesh_.mNormals[source_of_[triangle.at(k)]];
                corners.at(k).normal = {n.x, n.y, n.z};
            }
        }
    }

private:
    const aiMesh& mesh_;
    std::vector<std::uint32_t> source_of_; ///< [merged vertex] index in the mesh
};

} // namespace

ImportedMesh imported_mesh(const aiMesh& mesh, VertexNormals normals)
{
    check_indices(mesh);
    check_corners(mesh);
    ImportedMesh result;
    VertexTable table{result.vertices, mesh.mNumVertices};
    std::vector<std::uint32_t> index_of(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiVector3D& p = mesh.mVertices[v];
        index_of[v] = table.index_of({p.x, p.y, p.z});
    }
    result.triangles.reserve(mesh.mNumFaces);
    const bool keeps_normals = normals == VertexNormals::kept && mesh.HasNormals();
    FaceAttributes face_attributes{mesh, keeps_normals ? result.vertices.size() : 0};
    std::vector<std::uint32_t> polygon;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices < 3) {
            ++result.ignored_primitives;
            continue;
        }
        polygon.clear();
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            polygon.push_back(index_of[face.mIndices[k]]);
        }
        const std::size_t first = result.triangles.size();
        triangulate(result.vertices, polygon, result.triangles);
        if (keeps_normals) {
            face_attributes.append(face, polygon, std::span{result.triangles}.subspan(first),
                                   result.attributes);
        }
    }
    return result;
}

} // namespace gnomon::scene
