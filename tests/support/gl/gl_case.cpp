#include "gl_case.hpp"

#include "methods_job.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <memory>

namespace gnomon::tests {
namespace {

struct SharedContext {
    std::unique_ptr<raster_gl::Context> context;
    std::string missing;

    SharedContext()
    {
        try {
            context = std::make_unique<raster_gl::Context>();
        } catch (const scene::EnvironmentError& error) {
            missing = error.what();
        }
    }
};

SharedContext& shared()
{
    static SharedContext instance;
    return instance;
}

} // namespace

raster_gl::Context* shared_context()
{
    return shared().context.get();
}

const std::string& gl_is_missing()
{
    return shared().missing;
}

bool shader_arithmetic_is_ieee()
{
    return shared_context()->facts().renderer.find("llvmpipe") != std::string::npos;
}

bool is_mesa()
{
    return shared_context()->facts().version.find("Mesa") != std::string::npos;
}

scene::RasterModel raster_model()
{
    return {.subpixel_bits = shared_context()->facts().subpixel_bits,
            .interpolates_from_snapped = !shader_arithmetic_is_ieee()};
}

GlCase::GlCase(const std::string& builtin, const std::vector<scene::Override>& keys)
    : job{tests::builtin_job(builtin, keys).job},
      file{scene::load_scene(job.scene)},
      view{resolve_view(job, file.scene, file.defaults)},
      gpu{*shared_context(), file.scene},
      receiver_pass{*shared_context()},
      shadow_map_pass{*shared_context()},
      lookup_pass{*shared_context()},
      builtin_{builtin}
{
}

void GlCase::set(const std::vector<scene::Override>& keys)
{
    job = tests::builtin_job(builtin_, keys).job;
    view = resolve_view(job, file.scene, file.defaults);
}

void GlCase::draw_receivers()
{
    receivers = &receiver_pass.render(gpu, view, file.scene.bounds());
}

void GlCase::draw_shadow_map()
{
    map = &shadow_map_pass.render(gpu, view.maps, job.shadow_map);
}

void GlCase::look_up()
{
    lookup_pass.render(looked_up(), job, view);
}

raster_gl::LookupSource GlCase::looked_up() const
{
    return {gpu, *receivers, *map};
}

void GlCase::draw_all()
{
    draw_receivers();
    draw_shadow_map();
    look_up();
}

} // namespace gnomon::tests
