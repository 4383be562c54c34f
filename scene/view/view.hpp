#pragma once

#include "scene/job/job.hpp"
#include "scene/scene_defaults.hpp"
#include "scene/view/map_choice.hpp"

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
    /// Numbers of the keys "bias.…" that were handed over and the job's method has, by key.
    std::map<std::string, float, std::less<>> handed = {};

    /// What `handed` has of the key, or nothing.
    [[nodiscard]] std::optional<float> find_handed(std::string_view key) const;
};

/// The scene's own biases, each rounded to float32 once; constant_m [m] is divided by far − near
/// before.
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] Bias resolve_bias(const BiasSettings& settings, const LightFrustum& frustum);

/// A job made concrete against its scene: every exact input, ready for both renderers.
struct View {
    Camera camera;
    ImageSize image;
    Light light;
    /// What each shadow map sees, all of one size, at most `most_maps`; a point light has none.
    std::vector<LightFrustum> maps;
    Bias bias;
    MapChoice map_choice = MapChoice::containing; ///< which of several maps a receiver reads

    /// The first map's, and of a light with one map the only one: whose light distances and ranges
    /// are those of all.
    /// @throws std::logic_error  if there is no map.
    [[nodiscard]] const LightFrustum& first_map() const;
};

/// Resolves camera, light, its map and bias; of a point light camera and light alone.
/// @throws InputError  naming the key, e.g. for constant_m with a spot, or a subnormal bias.
[[nodiscard]] View resolve_view(const Job& job, const TriangleScene& scene,
                                const SceneDefaults& defaults);

/// The camera that a job means: its own, the scene file's, or one that frames the scene.
[[nodiscard]] CameraSettings resolve_camera(const Job& job, const TriangleScene& scene,
                                            const SceneDefaults& defaults);
/// The light that a job means: its own, the scene file's, or the default one.
[[nodiscard]] LightSettings resolve_light(const Job& job, const SceneDefaults& defaults);

} // namespace gnomon::scene
