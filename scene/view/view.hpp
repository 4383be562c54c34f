#pragma once

#include "scene/light/map_choice.hpp"
#include "scene/settings/job.hpp"
#include "scene/settings/scene_defaults.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The bias as GL receives it: float32, each 0 or a normal float; constant and slope in depth
/// units. Without what a member or an entry says, there is no such bias.
struct Bias {
    float constant = 0;
    float slope = 0;
    float normal_texels = 0;
    /// Numbers of the keys "bias.…" that layers above add and the job's method has, by key.
    std::map<std::string, float, std::less<>> added = {};

    /// What `added` has of the key, or nothing.
    [[nodiscard]] std::optional<float> find_added(std::string_view key) const;
};

/// The scene's own biases, each rounded to float32 once, a constant bias in another unit after it
/// is divided by what a depth unit is (`BiasUnit::per_depth`).
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] Bias resolve_bias(const BiasSettings& settings, const LightFrustum& frustum);

/// A job made concrete against its scene: every exact input, ready for both renderers.
struct View {
    Camera camera;
    ImageSize image;
    Light light;
    /// What each shadow map sees, all of one size, at most `most_maps`; another renderer's point
    /// light has none.
    std::vector<LightFrustum> maps;
    Bias bias;
    MapChoice map_choice = MapChoice::containing; ///< which of several maps a receiver reads
    ViewSlices slices;                            ///< of cascades
    /// What the constant bias is multiplied with in each map, in float32, where one number of depth
    /// units is not the same length in all and the job gives metres; the first is 1. Empty: with
    /// nothing.
    std::vector<float> bias_scales;

    /// The first map's, and of a light with one map the only one: whose ranges are those of all.
    /// @throws std::logic_error  if there is no map.
    [[nodiscard]] const LightFrustum& first_map() const;
    /// Light distance of a point in the map that a receiver there reads [m].
    /// @throws std::logic_error  if there is no map.
    [[nodiscard]] double light_distance_m(const Vec3d& point) const;
    /// What people call a map: a cube's face "+x", another by its index.
    [[nodiscard]] std::string map_name(std::size_t map) const;
};

/// The job with its maps' layout said: that of the scene's light, where the job leaves both to the
/// scene.
[[nodiscard]] Job with_layout(Job job, const SceneDefaults& defaults);

/// Resolves camera, light, its maps and bias.
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] View resolve_view(const Job& job, const TriangleScene& scene,
                                const SceneDefaults& defaults);

/// Resolves camera and light alone, as for another renderer's shadows.
[[nodiscard]] View resolve_view_without_maps(const Job& job, const TriangleScene& scene,
                                             const SceneDefaults& defaults);

/// The camera that a job means: its own, the scene file's, or one that frames the scene.
[[nodiscard]] CameraSettings resolve_camera(const Job& job, const TriangleScene& scene,
                                            const SceneDefaults& defaults);
/// The same, with a target where people would say that it looks. A file's camera looks along a
/// direction: its target is as far ahead as the scene's centre.
[[nodiscard]] CameraSettings aimed_camera(const Job& job, const TriangleScene& scene,
                                          const SceneDefaults& defaults);
/// The light that a job means: its own, the scene file's, or the default one.
[[nodiscard]] LightSettings resolve_light(const Job& job, const SceneDefaults& defaults);

} // namespace gnomon::scene
