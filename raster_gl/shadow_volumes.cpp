#include "raster_gl/shadow_volumes.hpp"

#include "raster_gl/readback.hpp"
#include "scene/camera/camera.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {
namespace {

bool is_same(const scene::Light& a, const scene::Light& b)
{
    return a.type == b.type && a.direction == b.direction && a.position == b.position;
}

/// An orthographic camera sees all points at infinity as one, which no face covers.
bool has_finite_volumes(const scene::View& view)
{
    return view.camera.projection == scene::Projection::orthographic;
}

/// Scales the direction exactly, so that its components are at most 1 and drivers flush none to
/// zero.
scene::Vec3d scaled_to_one(const scene::Vec3d& direction)
{
    const double largest =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    return direction * std::ldexp(1.0, -std::ilogb(largest) - 1);
}

scene::Vec4f homogeneous_light(const scene::Light& light)
{
    return light.has_position() ? scene::Vec4f{scene::Vec4d{light.position, 1.0}}
                                : scene::Vec4f{scene::Vec4d{-scaled_to_one(light.direction), 0.0}};
}

/// An offset along a directional light that ends its volumes beyond the box.
scene::Vec3f directional_end(const scene::Light& light, const scene::Box& box)
{
    return scene::Vec3f{glm::normalize(light.direction) * (2 * box.diagonal_m())};
}

/// How far volumes extend behind a vertex, in multiples of its distance from the light. A volume
/// ends this times h behind a caster's plane at distance h from the light. That is beyond the box
/// unless h is less than 1/64 of the light's distance from the box or 1/1024 of the box. A larger
/// value would cost precision of the ends' image positions.
float extension(const scene::Light& light, const scene::Box& box)
{
    constexpr double most = 1024;
    const scene::Vec3d outside = glm::max(
        glm::max(box.lower - light.position, light.position - box.upper), scene::Vec3d{0, 0, 0});
    const double needed = 64 * box.diagonal_m() / glm::length(outside); // infinite inside the box
    return static_cast<float>(std::min(needed, most));
}

/// @throws scene::InputError  if one draw call cannot hold the volumes.
void require_drawable(const VolumeGeometry& geometry)
{
    std::size_t corners = 0;
    for (const VolumeFaces* faces : {&geometry.along, &geometry.against}) {
        corners += 2 * 3 * (faces->caps.size() + faces->sides.size());
    }
    constexpr std::size_t most = std::numeric_limits<GLsizei>::max();
    if (corners > most) {
        throw scene::InputError(fmt::format(
            "method.name = \"shadow_volumes\": the volumes have {} corners and GL draws "
            "at most {}; set method.extrusion = \"silhouette\", or use a smaller scene",
            corners, most));
    }
}

/// Collects vertex indices of volume faces: caster corners and their far ends.
class IndexList {
public:
    explicit IndexList(std::uint32_t vertex_count) : vertex_count_{vertex_count} {}

    void add_near_caps(const VolumeFaces& faces)
    {
        for (const auto& corners : faces.caps) {
            indices_.insert(indices_.end(), corners.begin(), corners.end());
        }
    }
    void add_far_caps(const VolumeFaces& faces)
    {
        for (const auto& corners : faces.caps) {
            for (const std::uint32_t corner : corners) {
                indices_.push_back(far_end(corner));
            }
        }
    }
    void add_sides(const VolumeFaces& faces)
    {
        for (const auto& [from, to] : faces.sides) {
            for (const std::uint32_t corner :
                 {to, from, far_end(from), to, far_end(from), far_end(to)}) {
                indices_.push_back(corner);
            }
        }
    }
    [[nodiscard]] const std::vector<std::uint32_t>& indices() const { return indices_; }

private:
    [[nodiscard]] std::uint32_t far_end(std::uint32_t vertex) const
    {
        return vertex_count_ + vertex;
    }

    std::uint32_t vertex_count_;
    std::vector<std::uint32_t> indices_;
};

/// Scope that counts faces behind the existing depths in the stencil.
class StencilCountScope {
public:
    StencilCountScope()
    {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        // Depth is reversed. An equal depth fails as well: there the ray enters the volume of the
        // pixel's own caster, and leaves it again.
        glDepthFunc(GL_GREATER);
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_ALWAYS, 0, 0xFF);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
        glDisable(GL_CULL_FACE);
    }
    StencilCountScope(const StencilCountScope&) = delete;
    StencilCountScope& operator=(const StencilCountScope&) = delete;
    ~StencilCountScope()
    {
        glDisable(GL_STENCIL_TEST);
        glDisable(GL_DEPTH_CLAMP);
        glFrontFace(GL_CCW);
        glDepthMask(GL_TRUE);
    }
};

Program make_volume_program(const char* is_finite)
{
    return make_program({"shadow_volumes.vert", {}, {{"FINITE", is_finite}}, nullptr});
}

Program make_verdict_program(const char* is_positional)
{
    return make_program({"fullscreen.vert",
                         "volume_verdict.frag",
                         {{"POSITIONAL", is_positional}},
                         nullptr,
                         std::string{shader_source("receiver_angle.glsl")}});
}

} // namespace

ShadowVolumePass::ShadowVolumePass(const Context& context, const scene::TriangleScene& triangles)
    : context_{context},
      triangles_{triangles},
      box_{triangles.bounds()}
{
}

void ShadowVolumePass::upload_vertices()
{
    if (!vertices_.empty()) {
        return;
    }
    infinite_ = make_volume_program("0");
    finite_ = make_volume_program("1");
    verdict_of_position_ = make_verdict_program("1");
    verdict_of_direction_ = make_verdict_program("0");
    no_attributes_ = make_vertex_array();
    const auto bytes = static_cast<GLsizeiptr>(triangles_.vertices.size() * sizeof(scene::Vec3f));
    vertices_ = make_buffer();
    glNamedBufferStorage(vertices_.name(), 2 * bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
    for (const GLsizeiptr first : {GLsizeiptr{0}, bytes}) {
        glNamedBufferSubData(vertices_.name(), first, bytes, triangles_.vertices.data());
    }
    layout_ = make_vertex_array();
    glVertexArrayVertexBuffer(layout_.name(), 0, vertices_.name(), 0, sizeof(scene::Vec3f));
    glEnableVertexArrayAttrib(layout_.name(), 0);
    glVertexArrayAttribFormat(layout_.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(layout_.name(), 0, 0);
    context_.check("uploading the shadow volumes' vertices");
}

void ShadowVolumePass::prepare(const scene::Light& light, const methods::ShadowVolumes& volumes)
{
    upload_vertices();
    if (geometry_ && is_same(geometry_->light, light) && geometry_->volumes == volumes) {
        return;
    }
    const VolumeGeometry made = volume_geometry(triangles_, light, volumes);
    require_drawable(made);
    IndexList list{static_cast<std::uint32_t>(triangles_.vertices.size())};
    const auto added = [&](const auto& add) {
        const std::size_t first = list.indices().size();
        add();
        return Range{first, list.indices().size() - first};
    };
    const auto add_faces = [&](const VolumeFaces& own, const VolumeFaces& others) {
        return Faces{added([&] { list.add_near_caps(own); }), added([&] {
                         list.add_sides(own);
                         list.add_far_caps(
                             others); // their winding is reversed as seen from the light
                     })};
    };
    Geometry geometry{light, volumes, make_buffer(), add_faces(made.along, made.against),
                      add_faces(made.against, made.along)};
    const std::vector<std::uint32_t>& indices = list.indices();
    // GL has no empty buffers.
    glNamedBufferStorage(
        geometry.indices.name(),
        static_cast<GLsizeiptr>(std::max<std::size_t>(indices.size(), 1) * sizeof(std::uint32_t)),
        indices.empty() ? nullptr : indices.data(), 0);
    glVertexArrayElementBuffer(layout_.name(), geometry.indices.name());
    context_.check("uploading the shadow volumes");
    geometry_ = std::move(geometry);
}

void ShadowVolumePass::allocate(scene::ImageSize size)
{
    if (size_ == size) {
        return;
    }
    depth_stencil_ = make_texture(GL_DEPTH32F_STENCIL8, size.width_px, size.height_px);
    glTextureParameteri(depth_stencil_.name(), GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    counted_ = make_framebuffer();
    glNamedFramebufferTexture(counted_.name(), GL_DEPTH_STENCIL_ATTACHMENT, depth_stencil_.name(),
                              0);
    glNamedFramebufferDrawBuffer(counted_.name(), GL_NONE);
    samples_ = make_texture(GL_RGBA32F, size.width_px, size.height_px);
    target_ = make_framebuffer();
    glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0, samples_.name(), 0);
    context_.check(fmt::format("allocating a {}×{} volume count", size.width_px, size.height_px));
    size_ = size;
}

const Program& ShadowVolumePass::volume_program(const scene::View& view)
{
    const Program& program = has_finite_volumes(view) ? finite_ : infinite_;
    set_uniform(program, "camera_clip_from_world",
                scene::Mat4f{scene::camera_clip_from_world(view.camera, view.image, box_)});
    set_uniform(program, "first_far_vertex",
                static_cast<std::uint32_t>(triangles_.vertices.size()));
    set_uniform(program, "light", homogeneous_light(view.light));
    if (view.light.has_position()) {
        set_uniform(program, "extension", extension(view.light, box_));
    } else {
        set_uniform(program, "directional_end", directional_end(view.light, box_));
    }
    return program;
}

void ShadowVolumePass::draw_view(const VolumeReceivers& from, const Program& program) const
{
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    from.scene.draw_receivers(program);
}

void ShadowVolumePass::draw_faces(const Faces& faces, GLenum front) const
{
    const auto draw = [](const Range& range) {
        const std::uintptr_t first_byte = std::uintptr_t{range.first} * sizeof(std::uint32_t);
        // GL takes the byte offset as a pointer.
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(first_byte));
    };
    glFrontFace(front);
    glDisable(GL_DEPTH_CLAMP); // as for the receivers, so that depths agree
    draw(faces.near_caps);
    glEnable(GL_DEPTH_CLAMP);
    draw(faces.rest);
}

void ShadowVolumePass::count_volumes(const Program& program) const
{
    const StencilCountScope state;
    glUseProgram(program.name());
    glBindVertexArray(layout_.name());
    draw_faces(geometry_->outward, GL_CCW);
    draw_faces(geometry_->inward, GL_CW);
}

scene::LookupLayers ShadowVolumePass::look_up(const VolumeReceivers& from, const scene::View& view,
                                              const methods::ShadowVolumes& volumes)
{
    if (!(from.receivers.size == view.image)) {
        throw std::invalid_argument(
            "ShadowVolumePass: the receivers' size differs from the view's");
    }
    prepare(view.light, volumes);
    allocate(view.image);
    const Program& program = volume_program(view);
    glBindFramebuffer(GL_FRAMEBUFFER, counted_.name());
    glViewport(0, 0, view.image.width_px, view.image.height_px);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthMask(GL_TRUE);
    glStencilMask(0xFF);
    constexpr float infinitely_far = 0;
    glClearNamedFramebufferfi(counted_.name(), GL_DEPTH_STENCIL, 0, infinitely_far, 0);
    glUseProgram(program.name());
    draw_view(from, program);
    count_volumes(program);
    return decide(from, view);
}

scene::LookupLayers ShadowVolumePass::decide(const VolumeReceivers& from, const scene::View& view)
{
    const bool is_positional = view.light.has_position();
    const Program& verdict = is_positional ? verdict_of_position_ : verdict_of_direction_;
    set_uniform(verdict, "light",
                is_positional ? scene::Vec3f{view.light.position}
                              : scene::Vec3f{-glm::normalize(view.light.direction)});
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glDisable(GL_DEPTH_TEST);
    from.scene.bind_normals(5);
    glBindTextureUnit(0, from.receivers.triangle.name());
    glBindTextureUnit(2, from.receivers.world_position.name());
    glBindTextureUnit(3, depth_stencil_.name());
    glBindVertexArray(no_attributes_.name());
    glUseProgram(verdict.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glUseProgram(0);
    glFinish();
    constexpr float no_texel = std::numeric_limits<float>::quiet_NaN();
    scene::LookupLayers layers{
        read_texture<scene::LookupSample>(samples_, size_, GL_RGBA, GL_FLOAT),
        scene::Image<scene::Vec2f>{size_, scene::Vec2f{no_texel, no_texel}}};
    context_.check("counting shadow volumes");
    return layers;
}

} // namespace gnomon::raster_gl
