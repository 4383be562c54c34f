#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/program.hpp"
#include "scene/geometry/triangles.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// The scene in GL's buffers: vertices, indices, and a unit geometric normal per triangle; beside
/// them, where the scene has them, vertices with their normals.
class GpuScene {
public:
    /// @throws scene::EnvironmentError  if GL has no room for it.
    GpuScene(const Context& context, const scene::TriangleScene& triangles);

    /// Draws the casting triangles with the current program, `program`; sets its uniform
    /// first_triangle for every draw, so that first_triangle + gl_PrimitiveID is the triangle's
    /// index in the scene.
    void draw_casters(const Program& program) const;
    /// The same, some thousands at a time, each waited for: what a software renderer binned and the
    /// targets that it keeps for it stay few.
    void draw_casters_in_parts(const Program& program) const;
    /// Draws the receiving triangles; sets first_triangle in the same way.
    void draw_receivers(const Program& program) const;
    /// The same with normals, as the attribute at location 1.
    /// Precondition: `has_vertex_normals()`.
    void draw_receivers_with_normals(const Program& program) const;
    [[nodiscard]] bool has_vertex_normals() const { return !corners_.empty(); }
    /// Draws every vertex once as a point, in order.
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
    Buffer corners_; ///< of triangles, each with its normal; empty: there are none
    std::vector<scene::TriangleRange> casters_;
    std::vector<scene::TriangleRange> receivers_;
    std::size_t vertex_count_ = 0;
};

} // namespace gnomon::raster_gl
