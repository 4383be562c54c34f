#include "raster_gl/receivers.hpp"

#include "raster_gl/gl_object.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/readback.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>

namespace gnomon::raster_gl {

namespace {

void clear(const Framebuffer& target, bool has_normals)
{
    constexpr std::array<GLuint, 4> nothing{scene::no_triangle, 0, 0, 0};
    constexpr std::array<GLfloat, 4> zero{};
    constexpr GLfloat infinitely_far = 0.0F;
    glClearNamedFramebufferuiv(target.name(), GL_COLOR, 0, nothing.data());
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 1, zero.data());
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 2, zero.data());
    if (has_normals) {
        glClearNamedFramebufferfv(target.name(), GL_COLOR, 3, zero.data());
    }
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &infinitely_far);
}

} // namespace

ReceiverPass::ReceiverPass(const Context& context)
    : context_{context},
      program_{make_receiver_program(false)},
      target_{make_framebuffer()}
{
    context.check("compiling the receiver program");
}

void ReceiverPass::allocate(scene::ImageSize size, bool has_normals)
{
    const int largest =
        std::min(context_.facts().max_texture_texels, context_.facts().max_viewport_px);
    if (std::max(size.width_px, size.height_px) > largest) {
        throw scene::InputError(
            fmt::format("image.width = {}, image.height = {}: this driver draws at most {} pixels "
                        "a side",
                        size.width_px, size.height_px, largest));
    }
    if (buffer_.size == size && has_normals != buffer_.vertex_normal.empty()) {
        return;
    }
    buffer_ = {};
    const auto texture = [&](GLenum format) {
        return make_texture(format, size.width_px, size.height_px);
    };
    buffer_.triangle = texture(GL_R32UI);
    buffer_.light_clip = texture(GL_RGBA32F);
    buffer_.world_position = texture(GL_RGBA32F);
    buffer_.depth = texture(GL_DEPTH_COMPONENT32F);
    if (has_normals) {
        buffer_.vertex_normal = texture(GL_RGBA32F);
    }
    context_.check(fmt::format("allocating {}×{} receiver buffers", size.width_px, size.height_px));
    buffer_.size = size;
}

ReceiverBuffer ReceiverPass::take()
{
    target_ = make_framebuffer(); // a framebuffer keeps its attachments alive
    return std::exchange(buffer_, {});
}

void ReceiverPass::attach() const
{
    const GLuint name = target_.name();
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, buffer_.triangle.name(), 0);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT1, buffer_.light_clip.name(), 0);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT2, buffer_.world_position.name(), 0);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT3, buffer_.vertex_normal.name(), 0);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, buffer_.depth.name(), 0);
    constexpr std::array<GLenum, 4> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                            GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3};
    glNamedFramebufferDrawBuffers(name, buffer_.vertex_normal.empty() ? 3 : 4, outputs.data());
}

const ReceiverBuffer& ReceiverPass::render(const GpuScene& scene, const scene::View& view,
                                           const scene::Box& box)
{
    const bool has_normals = scene.has_vertex_normals();
    if (has_normals && program_with_normals_.empty()) {
        program_with_normals_ = make_receiver_program(true);
    }
    const Program& program = has_normals ? program_with_normals_ : program_;
    allocate(view.image, has_normals);
    attach();
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glViewport(0, 0, view.image.width_px, view.image.height_px);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glDisable(GL_CULL_FACE);
    clear(target_, has_normals);
    set_uniform(program, "clip_from_world",
                scene::Mat4f{scene::camera_clip_from_world(view.camera, view.image, box)});
    const scene::Mat4f no_map{1};
    set_uniform(program, "light_clip_from_world",
                view.maps.empty() ? no_map : view.first_map().light_clip_from_world);
    glUseProgram(program.name());
    if (has_normals) {
        scene.draw_receivers_with_normals(program);
    } else {
        scene.draw_receivers(program);
    }
    glFinish();
    context_.check("rendering the receivers");
    return buffer_;
}

scene::Image<std::uint32_t> read_triangles(const Context& context, const ReceiverBuffer& buffer)
{
    auto image =
        read_texture<std::uint32_t>(buffer.triangle, buffer.size, GL_RED_INTEGER, GL_UNSIGNED_INT);
    context.check("reading the receivers' triangles");
    return image;
}

scene::Image<scene::Vec4f> read_light_clip(const Context& context, const ReceiverBuffer& buffer)
{
    auto image = read_texture<scene::Vec4f>(buffer.light_clip, buffer.size, GL_RGBA, GL_FLOAT);
    context.check("reading the receivers' light clip coordinates");
    return image;
}

scene::Image<scene::Vec4f> read_world_positions(const Context& context,
                                                const ReceiverBuffer& buffer)
{
    auto image = read_texture<scene::Vec4f>(buffer.world_position, buffer.size, GL_RGBA, GL_FLOAT);
    context.check("reading the receivers' world positions");
    return image;
}

scene::Image<scene::Vec4f> read_vertex_normals(const Context& context, const ReceiverBuffer& buffer)
{
    auto image = read_texture<scene::Vec4f>(buffer.vertex_normal, buffer.size, GL_RGBA, GL_FLOAT);
    context.check("reading the receivers' normals");
    return image;
}

std::vector<scene::Vec4f> capture_clip_positions(const Context& context, const GpuScene& scene,
                                                 const scene::Mat4f& clip_from_world)
{
    const Program program = make_position_program();
    std::vector<scene::Vec4f> positions(scene.vertex_count());
    const auto bytes = static_cast<GLsizeiptr>(positions.size() * sizeof(scene::Vec4f));
    const Framebuffer nothing = make_framebuffer(); // drawing needs a complete framebuffer
    glNamedFramebufferParameteri(nothing.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(nothing.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, nothing.name());
    const Buffer captured = make_buffer();
    glNamedBufferStorage(captured.name(), bytes, nullptr, 0);
    set_uniform(program, "clip_from_world", clip_from_world);
    glUseProgram(program.name());
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, captured.name());
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    scene.draw_vertices();
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glGetNamedBufferSubData(captured.name(), 0, bytes, positions.data());
    context.check("capturing clip positions");
    return positions;
}

} // namespace gnomon::raster_gl
