#pragma once

#include "gl_case.hpp"
#include "raster_gl/prefilter.hpp"
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
#include <string>
#include <vector>

namespace gnomon::tests {

/// A scene before a light, its receivers drawn, and a map, drawn or given, with what the job's
/// method makes of it.
class MethodCase {
public:
    MethodCase(scene::Job job, scene::SceneFile file);
    MethodCase(const std::string& builtin, const std::vector<scene::Override>& keys);

    /// Another job of the same scene, camera and image; the map is to be made anew.
    void set(scene::Job job);
    void draw_map();
    /// @param depths  top left first.
    void give_map(scene::Image<float> depths);
    /// @param of_samples  as many as the method reads of each texel; top left first.
    void give_samples(std::vector<scene::Image<float>> of_samples);
    [[nodiscard]] scene::LookupLayers look_up(float constant_bias = 0);
    [[nodiscard]] scene::Image<float> find_critical_biases();
    /// What a level of the method's blurred map holds: red, green, blue, alpha; lower left first.
    [[nodiscard]] std::array<scene::Image<double>, 4> stored(int level = 0) const;
    [[nodiscard]] scene::Image<std::uint32_t> triangles() const;

    scene::Job job;
    scene::SceneFile file;
    scene::View view;

private:
    [[nodiscard]] raster_gl::LookedUp looked_up() const;
    void prefilter(const raster_gl::SampledDepths& samples);

    struct Passes;
    /// Gives passes back when their case ends.
    struct GiveBack {
        void operator()(Passes* passes) const;
    };
    static std::unique_ptr<Passes, GiveBack> take_passes();

    raster_gl::GpuScene gpu_;
    std::unique_ptr<Passes, GiveBack> passes_;
    std::optional<raster_gl::ShadowVolumePass> volume_pass_; ///< empty until it looks up
    const raster_gl::ReceiverBuffer* receivers_ = nullptr;
    const raster_gl::ShadowMap* map_ = nullptr;
    const raster_gl::LayeredTexture* filtered_ = nullptr;
};

/// A job's method with one of its filters, or another value of a key of its own.
struct Configuration {
    std::string label;
    std::vector<scene::Override> keys;

    friend void PrintTo(const Configuration& shown, std::ostream* out) { *out << shown.label; }
};

/// All methods of the list: each with its defaults, each filter, and each of its own keys at other
/// values: each word, the other flag, the largest integer, the smallest power of two;
/// of samples as many as drivers have. Keys that methods share, and offsets along the normals of
/// vertices, are tried of the first of them, in the full lane of all.
[[nodiscard]] std::vector<Configuration> configurations();

/// Both lists of keys, the second over the first.
[[nodiscard]] std::vector<scene::Override> with(std::vector<scene::Override> keys,
                                                const std::vector<scene::Override>& more);

/// Keys that the method of the keys lacks are left away.
[[nodiscard]] scene::Job job_of_builtin(const std::string& builtin,
                                        const std::vector<scene::Override>& keys);

} // namespace gnomon::tests
