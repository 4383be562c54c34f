#include "raster_gl/clip_positions.hpp"

#include "raster_gl/gl_object.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/scene_programs.hpp"

namespace gnomon::raster_gl {

std::vector<scene::Vec4f> capture_clip_positions(const Context& context, const GpuScene& scene,
                                                 const scene::Mat4f& clip_from_world)
{
    const Program program = make_position_program();
    std::vector<scene::Vec4f> positions(scene.vertex_count());
    const auto bytes = static_cast<GLsizeiptr>(positions.size() * sizeof(scene::Vec4f));
    const Framebuffer nothing = make_framebuffer(); // drawing needs a complete one all the same
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
