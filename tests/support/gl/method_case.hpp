#pragma once

#include "gl_case.hpp"
#include "raster_gl/map/prefilter.hpp"
#include "raster_gl/shadow_volumes.hpp"
#include "scene/image.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {

/// A lit scene with its receivers drawn, and a shadow map, drawn or given, that the job's method
/// has filtered.
class MethodCase {
public:
    MethodCase(scene::Job job, scene::SceneFile file);
    MethodCase(const std::string& builtin, const std::vector<scene::Override>& keys);

    /// Sets another job of the same scene, camera and image. Invalidates the map.
    void set(scene::Job job);
    void draw_map();
    /// @param depths  Top row first.
    void give_map(scene::Image<float> depths);
    /// @param of_samples  An image for each sample that the method reads from a texel; top row
    /// first.
    void give_samples(std::vector<scene::Image<float>> of_samples);
    [[nodiscard]] scene::LookupLayers look_up(float constant_bias = 0);
    [[nodiscard]] scene::Image<float> find_critical_biases();
    /// The channels of a level of the method's filtered map; bottom row first.
    [[nodiscard]] std::array<scene::Image<double>, 4> stored(int level = 0) const;
    [[nodiscard]] scene::Image<std::uint32_t> triangles() const;

    scene::Job job;
    scene::SceneFile file;
    scene::View view;

private:
    [[nodiscard]] raster_gl::LookupSource looked_up() const;
    void prefilter(const raster_gl::SampledDepths& samples);

    struct Passes;
    /// Returns the passes to the pool.
    struct GiveBack {
        void operator()(Passes* passes) const;
    };
    static std::unique_ptr<Passes, GiveBack> take_passes();

    raster_gl::GpuScene gpu_;
    std::unique_ptr<Passes, GiveBack> passes_;
    std::optional<raster_gl::ShadowVolumePass> volume_pass_; ///< empty before the first lookup
    const raster_gl::ReceiverBuffer* receivers_ = nullptr;
    const raster_gl::ShadowMap* map_ = nullptr;
    const raster_gl::LayeredTexture* filtered_ = nullptr;
};

/// Keys that set a method, and one of its filters or a value of one of its own keys.
struct Configuration {
    std::string label;
    std::vector<scene::Override> keys;

    friend void PrintTo(const Configuration& shown, std::ostream* out) { *out << shown.label; }
};

/// Each listed method with its defaults, with each filter, and with other values of its own keys.
/// The usual lane tries a key that several methods share, and offsets along vertex normals, with
/// the first of these methods; the full lane with each.
[[nodiscard]] std::vector<Configuration> configurations();

/// Both lists of keys; `more` overrides `keys`.
[[nodiscard]] std::vector<scene::Override> with(std::vector<scene::Override> keys,
                                                const std::vector<scene::Override>& more);

/// Ignores keys that the method does not have.
[[nodiscard]] scene::Job job_of_builtin(const std::string& builtin,
                                        const std::vector<scene::Override>& keys);

/// A level rectangle in world space [m].
struct Plate {
    double x0 = 0, x1 = 0; ///< x0 < x1
    double z0 = 0, z1 = 0; ///< z0 < z1
    double y = 0;
};

/// A ground at y = 0 from −4 to 4 m along x and z, and plates. Only the ground is seen, and only
/// the plates cast shadows.
[[nodiscard]] scene::SceneFile plates_over_ground(const std::vector<Plate>& plates);

/// Looks straight down on the ground with 128 × 128 pixels, under a light straight above. Texels
/// are 1/8 m wide: if plates lie on multiples of that, no pixel's or texel's centre lies on an
/// edge.
/// @param job  Provides the method; camera, light and map are replaced.
[[nodiscard]] scene::Job looking_down(scene::Job job);

/// Random depths in blocks of 8 × 8 texels. Each block has its own spread, from 0 to 1.
[[nodiscard]] scene::Image<float> random_depths(std::mt19937& random, int side);

} // namespace gnomon::tests
