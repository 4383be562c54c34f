#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/program.hpp"
#include "scene/geometry/triangles.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// The scene in GL buffers: vertices, indices, a unit geometric normal per triangle, and vertex
/// normals if the scene has them.
class GpuScene {
public:
    /// @throws scene::EnvironmentError  if it does not fit into GL memory.
    GpuScene(const Context& context, const scene::TriangleScene& triangles);

    /// Draws the casting triangles with `program`, which must be current. Sets its uniform
    /// first_triangle for each draw: first_triangle + gl_PrimitiveID is the triangle's index.
    void draw_casters(const Program& program) const;
    /// Draws the casters some thousands at a time and waits for each part, which limits the bins
    /// and targets that a software renderer keeps.
    void draw_casters_in_parts(const Program& program) const;
    /// Draws the receiving triangles; sets first_triangle as above.
    void draw_receivers(const Program& program) const;
    /// Draws the receiving triangles with vertex normals as attribute 1. Precondition:
    /// `has_vertex_normals()`.
    void draw_receivers_with_normals(const Program& program) const;
    [[nodiscard]] bool has_vertex_normals() const { return !corners_.empty(); }
    /// Draws every vertex once, in order, as a point.
    void draw_vertices() const;
    [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }

    /// Binds the normals as a buffer texture: RGBA32F per triangle, the double cross product
    /// normalised and rounded to float32.
    void bind_normals(GLuint texture_unit) const;

private:
    VertexArray layout_;
    Buffer vertices_;
    Buffer indices_;
    Buffer normals_;
    Texture normals_view_;
    VertexArray corner_layout_;
    Buffer corners_; ///< triangle corners with their normals; empty if there are none
    std::vector<scene::TriangleRange> casters_;
    std::vector<scene::TriangleRange> receivers_;
    std::size_t vertex_count_ = 0;
};

} // namespace gnomon::raster_gl
