#include "raster_gl/gpu_scene.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::raster_gl {
namespace {

template <typename T>
Buffer upload_buffer(const std::vector<T>& data)
{
    Buffer buffer = make_buffer();
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(data.size() * sizeof(T)),
                         data.data(), 0);
    return buffer;
}

std::vector<scene::Vec4f> unit_normals(const scene::TriangleScene& triangles)
{
    std::vector<scene::Vec4f> normals(triangles.triangles.size());
    for (std::uint32_t t = 0; t < normals.size(); ++t) {
        const auto corners = triangles.corners(t);
        const scene::Vec3d a{corners[0]};
        const scene::Vec3d normal =
            glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
        normals[t] = scene::Vec4f{scene::Vec4d{glm::normalize(normal), 0.0}};
    }
    return normals;
}

/// A triangle's corner with its vertex attributes, as receivers are drawn.
struct CornerVertex {
    scene::Vec3f position;
    scene::CornerAttributes attributes;
};
static_assert(sizeof(CornerVertex) == 6 * sizeof(float));

/// Expands vertices to corners, as a vertex on a crease has another normal in each triangle.
std::vector<CornerVertex> corner_vertices(const scene::TriangleScene& triangles)
{
    std::vector<CornerVertex> corners;
    corners.reserve(3 * triangles.triangles.size());
    for (std::uint32_t t = 0; t < triangles.triangles.size(); ++t) {
        const auto positions = triangles.corners(t);
        const scene::TriangleAttributes& attributes = triangles.attributes[t];
        for (std::size_t k = 0; k < positions.size(); ++k) {
            corners.push_back({positions.at(k), attributes.at(k)});
        }
    }
    return corners;
}

/// Adds an attribute of three floats from the buffer at binding 0.
void add_attribute(const VertexArray& layout, GLuint location, GLuint first_byte)
{
    glEnableVertexArrayAttrib(layout.name(), location);
    glVertexArrayAttribFormat(layout.name(), location, 3, GL_FLOAT, GL_FALSE, first_byte);
    glVertexArrayAttribBinding(layout.name(), location, 0);
}

void require_buffer_texture(std::size_t texels)
{
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
    if (texels > static_cast<std::size_t>(largest)) {
        throw scene::EnvironmentError(fmt::format(
            "the scene has {} triangles, and this driver's buffer textures hold {}: use a "
            "smaller scene or another device",
            texels, largest));
    }
}

Texture view_of(const Buffer& buffer)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    glTextureBuffer(name, GL_RGBA32F, buffer.name());
    return Texture{name};
}

void draw_range(const Program& program, const scene::TriangleRange& range)
{
    set_uniform(program, "first_triangle", range.first);
    const std::uintptr_t first_byte = std::uintptr_t{range.first} * 3 * sizeof(std::uint32_t);
    // GL takes the byte offset as a pointer.
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count * 3), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first_byte));
}

} // namespace

GpuScene::GpuScene(const Context& context, const scene::TriangleScene& triangles)
    : layout_{make_vertex_array()},
      vertices_{upload_buffer(triangles.vertices)},
      indices_{upload_buffer(triangles.triangles)},
      casters_{casting_ranges(triangles)},
      receivers_{receiving_ranges(triangles)},
      vertex_count_{triangles.vertices.size()}
{
    constexpr std::size_t largest_draw = 0x7FFFFFFFU / 3;
    if (triangles.triangles.size() > largest_draw) {
        throw scene::InputError(fmt::format("the scene has {} triangles: GL draws at most {}",
                                            triangles.triangles.size(), largest_draw));
    }
    const auto normals = unit_normals(triangles);
    require_buffer_texture(normals.size());
    normals_ = upload_buffer(normals);
    normals_view_ = view_of(normals_);
    glVertexArrayVertexBuffer(layout_.name(), 0, vertices_.name(), 0, sizeof(scene::Vec3f));
    glVertexArrayElementBuffer(layout_.name(), indices_.name());
    add_attribute(layout_, 0, 0);
    if (!triangles.attributes.empty()) {
        corner_layout_ = make_vertex_array();
        corners_ = upload_buffer(corner_vertices(triangles));
        glVertexArrayVertexBuffer(corner_layout_.name(), 0, corners_.name(), 0,
                                  sizeof(CornerVertex));
        add_attribute(corner_layout_, 0, 0);
        add_attribute(corner_layout_, 1, sizeof(scene::Vec3f));
    }
    context.check("uploading the scene");
}

void GpuScene::draw_casters(const Program& program) const
{
    glBindVertexArray(layout_.name());
    for (const scene::TriangleRange& range : casters_) {
        draw_range(program, range);
    }
}

void GpuScene::draw_casters_in_parts(const Program& program) const
{
    constexpr std::uint32_t part = 32768;
    glBindVertexArray(layout_.name());
    for (const scene::TriangleRange& range : casters_) {
        for (std::uint32_t first = 0; first < range.count; first += part) {
            draw_range(program, {range.first + first, std::min(part, range.count - first)});
            glFinish();
        }
    }
}

void GpuScene::draw_receivers(const Program& program) const
{
    glBindVertexArray(layout_.name());
    for (const scene::TriangleRange& range : receivers_) {
        draw_range(program, range);
    }
}

void GpuScene::draw_receivers_with_normals(const Program& program) const
{
    glBindVertexArray(corner_layout_.name());
    for (const scene::TriangleRange& range : receivers_) {
        set_uniform(program, "first_triangle", range.first);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(range.first * 3),
                     static_cast<GLsizei>(range.count * 3));
    }
}

void GpuScene::draw_vertices() const
{
    glBindVertexArray(layout_.name());
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertex_count_));
}

void GpuScene::bind_normals(GLuint texture_unit) const
{
    glBindTextureUnit(texture_unit, normals_view_.name());
}

} // namespace gnomon::raster_gl
