#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/lookup.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "raster_gl/receivers.hpp"
#include "scene/depth/driver_bound.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::tests {

/// The context that all GL tests share. Null if there is no driver; `gl_is_missing` says why.
raster_gl::Context* shared_context();
const std::string& gl_is_missing();

/// Whether every float32 operation of this driver's shaders, division included, is known to follow
/// IEEE 754. True for llvmpipe.
bool shader_arithmetic_is_ieee();

/// Whether Mesa drives the shared context.
bool is_mesa();

/// What is known of the shared driver. llvmpipe interpolates between corners before it snaps them;
/// for other drivers the worse case is assumed.
scene::RasterModel raster_model();

/// An uploaded scene with a job, and one of each pass.
class GlCase {
public:
    explicit GlCase(const std::string& builtin, const std::vector<scene::Override>& keys = {});

    /// Replaces the job of the same scene.
    void set(const std::vector<scene::Override>& keys);
    void draw_receivers();
    void draw_shadow_map();
    void look_up();
    void draw_all();
    /// The inputs of `look_up`.
    [[nodiscard]] raster_gl::LookupSource looked_up() const;

    scene::Job job;
    scene::SceneFile file;
    scene::View view;
    raster_gl::GpuScene gpu;
    raster_gl::ReceiverPass receiver_pass;
    raster_gl::ShadowMapPass shadow_map_pass;
    raster_gl::LookupPass lookup_pass;
    const raster_gl::ReceiverBuffer* receivers = nullptr;
    const raster_gl::ShadowMap* map = nullptr;

private:
    std::string builtin_;
};

} // namespace gnomon::tests

/// Skips the test if there is no OpenGL 4.5 driver.
#define GNOMON_REQUIRE_GL()                                                                        \
    if (gnomon::tests::shared_context() == nullptr) {                                              \
        GTEST_SKIP() << "no OpenGL: " << gnomon::tests::gl_is_missing();                           \
    }
