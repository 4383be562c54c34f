#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/light/map_choice.hpp"
#include "scene/settings/job.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The bias as GL receives it: float32, each 0 or a normal float; constant and slope in depth
/// units.
struct Bias {
    float constant = 0;
    float slope = 0;
    float normal_texels = 0;
    /// Numbers of the added keys "bias.…" of the job's method, by key.
    std::map<std::string, float, std::less<>> added = {};

    /// The value of the key in `added`, if it has one.
    [[nodiscard]] std::optional<float> find_added(std::string_view key) const;
};

/// Converts the settings' biases, each rounded to float32 once. A constant bias in another unit is
/// first divided by `BiasUnit::per_depth`.
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] Bias resolve_bias(const BiasSettings& settings, const LightFrustum& frustum);

/// A job resolved against its scene: all exact inputs for both renderers.
struct View {
    Camera camera;
    ImageSize image;
    Light light;
    /// The camera of each shadow map, at most `most_maps`; all maps have one size. Empty for
    /// another renderer's point light.
    std::vector<LightFrustum> maps;
    Bias bias;
    MapChoice map_choice = MapChoice::containing; ///< which of several maps a receiver reads
    ViewSlices slices;                            ///< for cascades
    /// Factors of the constant bias in each map, in float32, if depth units differ in length
    /// between maps and the job gives metres; the first is 1. May be empty.
    std::vector<float> bias_scales;

    /// The first map's camera; all maps share its depth range.
    /// @throws std::logic_error  if the light has no map.
    [[nodiscard]] const LightFrustum& first_map() const;
    /// Light distance of a point, in the map that a receiver there reads [m].
    /// @throws std::logic_error  if the light has no map.
    [[nodiscard]] double light_distance_m(const Vec3d& point) const;
    /// A map's display name: "+x" for a cube's face, else its index.
    [[nodiscard]] std::string map_name(std::size_t map) const;
};

/// The job with an explicit layout; if it leaves light and layout to the scene, that of the scene's
/// light.
[[nodiscard]] Job with_layout(Job job, const SceneDefaults& defaults);

/// Resolves camera, light, its maps and bias.
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] View resolve_view(const Job& job, const TriangleScene& scene,
                                const SceneDefaults& defaults);

/// Resolves camera and light alone, as for another renderer's shadows.
[[nodiscard]] View resolve_view_without_maps(const Job& job, const TriangleScene& scene,
                                             const SceneDefaults& defaults);

/// The job's camera: its own, the scene file's, or one that frames the scene.
[[nodiscard]] CameraSettings resolve_camera(const Job& job, const TriangleScene& scene,
                                            const SceneDefaults& defaults);
/// As `resolve_camera`, with a meaningful target. A file's camera only has a direction; its target
/// is placed as far ahead as the scene's centre.
[[nodiscard]] CameraSettings aimed_camera(const Job& job, const TriangleScene& scene,
                                          const SceneDefaults& defaults);
/// The job's light: its own, the scene file's, or the default.
[[nodiscard]] LightSettings resolve_light(const Job& job, const SceneDefaults& defaults);

} // namespace gnomon::scene
