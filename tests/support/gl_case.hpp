#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/lookup.hpp"
#include "raster_gl/receivers.hpp"
#include "raster_gl/shadow_map.hpp"
#include "scene/depth/driver_bound.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::tests {

/// The context that all GL tests share; null, with the reason in `gl_is_missing`, where there is no
/// driver.
raster_gl::Context* shared_context();
const std::string& gl_is_missing();

/// Is every float32 operation of this driver's shaders IEEE, division included? Known of llvmpipe.
bool shader_arithmetic_is_ieee();

/// Does Mesa drive the shared context?
bool is_mesa();

/// What the shared driver does, as far as it is known: of llvmpipe, that it interpolates between
/// corners before they are snapped; of others the worse is assumed.
scene::RasterModel raster_model();

/// A job resolved against its scene, uploaded, with one of each pass.
class GlCase {
public:
    explicit GlCase(const std::string& builtin, const std::vector<scene::Override>& keys = {});

    /// Resolves other keys against the same scene.
    void set(const std::vector<scene::Override>& keys);
    void draw_receivers();
    void draw_shadow_map();
    void look_up();
    void draw_all();
    /// What `look_up` reads.
    [[nodiscard]] raster_gl::LookedUp looked_up() const;

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

/// Skips by name where there is no OpenGL 4.5 driver.
#define GNOMON_REQUIRE_GL()                                                                        \
    if (gnomon::tests::shared_context() == nullptr) {                                              \
        GTEST_SKIP() << "no OpenGL: " << gnomon::tests::gl_is_missing();                           \
    }
