#include "scene/job/keys.hpp"

#include "scene/builtin/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::scene {
namespace {

constexpr Stages only_scene = static_cast<Stages>(Stage::scene);

/// The camera moves the map too, through fit = "camera".
constexpr Stages camera_stages = Stage::truth | Stage::receivers | Stage::shadow_map;
/// The receivers carry light clip coordinates.
constexpr Stages light_stages = Stage::truth | Stage::receivers | Stage::shadow_map;

KeySpec builtin_key()
{
    WordDomain names;
    for (const BuiltinScene& scene : builtin_scenes()) {
        names.words.push_back(scene.name);
    }
    KeySpec spec = member_key<std::string>(
        make_key("scene.builtin", "a built-in scene, or file instead", "", only_scene),
        std::move(names), [](auto& job) -> auto& { return job.scene.builtin; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        return job.scene.builtin.empty() ? std::nullopt : held(job.scene.builtin);
    };
    spec.example = "\"sphere-cube\"";
    return spec;
}

KeySpec file_key()
{
    return {.key =
                make_key("scene.file", "a .gltf, .glb, .obj or .ply file, relative to the job file",
                         "", only_scene),
            .domain = TextDomain{},
            .set = [](Job& job,
                      const JobValue& value) { job.scene.file = std::get<std::string>(value); },
            .get = [](const Job& job) -> std::optional<JobValue> {
                return job.scene.file.empty() ? std::nullopt : held(job.scene.file.string());
            },
            .example = "\"bunny.obj\""};
}

/// It makes several jobs of one (`JobSource`), and is no part of any of them.
KeySpec scene_lights_key()
{
    return {.key =
                make_key("scene.lights",
                         "which lights of the file are used where the job gives none: the first, "
                         "or each as one of several",
                         "\"first\"", only_scene),
            .domain = WordDomain{.words = {"first", "all"}},
            .set = [](Job&, const JobValue&) {},
            .get = [](const Job&) -> std::optional<JobValue> { return std::nullopt; }};
}

KeySpec unit_key()
{
    return {
        .key = make_key("scene.unit_m",
                        "how long a unit of the file is [{unit}]; without it lengths are taken "
                        "as they are, and called units",
                        "", only_scene, "m"),
        .domain = RealDomain{.lower = 1e-9, .upper = 1e9},
        .set = [](Job& job, const JobValue& value) { job.scene.unit_m = std::get<double>(value); },
        .get = [](const Job& job) -> std::optional<JobValue> {
            return job.scene.unit_m ? held(*job.scene.unit_m) : std::nullopt;
        },
        .example = "0.01"};
}

/// Only another axis than y is part of a job: what was measured before there was the key keeps its
/// identity.
KeySpec up_key()
{
    KeySpec spec = word_key<UpAxis>(
        make_key("scene.up", "which axis of the file points up; z is turned to y", "\"y\"",
                 only_scene),
        2, up_axis_name, [](auto& job) -> auto& { return job.scene.up; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        return job.scene.up == UpAxis::y ? std::nullopt
                                         : held(std::string{up_axis_name(job.scene.up)});
    };
    return spec;
}

std::vector<KeySpec> scene_keys()
{
    using Texts = std::vector<std::string>;
    return {builtin_key(),
            file_key(),
            scene_lights_key(),
            unit_key(),
            up_key(),
            member_key<bool>(
                make_key("scene.ground", "adds a ground plane under the scene's box", "false",
                         only_scene),
                FlagDomain{}, [](auto& job) -> auto& { return job.scene.ground; }),
            member_key<Texts>(
                make_key("scene.no_cast", "objects that cast no shadow, by name: still seen", "[]",
                         only_scene),
                TextListDomain{}, [](auto& job) -> auto& { return job.scene.no_cast; }),
            member_key<Texts>(
                make_key("scene.no_receive",
                         "objects that the camera does not see, by name: still "
                         "casting",
                         "[]", only_scene),
                TextListDomain{}, [](auto& job) -> auto& { return job.scene.no_receive; })};
}

Domain parameter_domain(const BuiltinParameter& parameter)
{
    if (!parameter.words.empty()) {
        return WordDomain{.words = parameter.words};
    }
    if (parameter.is_integer) {
        return IntegerDomain{static_cast<std::int64_t>(parameter.lower),
                             static_cast<std::int64_t>(parameter.upper)};
    }
    return RealDomain{.lower = parameter.lower, .upper = parameter.upper};
}

JobValue job_value(const BuiltinParameter& parameter, const SceneParameter& value)
{
    if (const auto* word = std::get_if<std::string>(&value)) {
        return *word;
    }
    const double number = std::get<double>(value);
    return parameter.is_integer ? JobValue{static_cast<std::int64_t>(number)} : JobValue{number};
}

SceneParameter scene_parameter(const JobValue& value)
{
    if (const auto* word = std::get_if<std::string>(&value)) {
        return *word;
    }
    const auto* integer = std::get_if<std::int64_t>(&value);
    return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
}

KeySpec parameter_key(const BuiltinScene& scene, const BuiltinParameter& parameter)
{
    return {.key = make_key(parameter_prefix(scene.name) + parameter.name,
                            parameter.description + (parameter.unit.empty() ? "" : " [{unit}]"),
                            to_toml(job_value(parameter, parameter.default_value)), only_scene,
                            parameter.unit),
            .domain = parameter_domain(parameter),
            .set =
                [name = parameter.name](Job& job, const JobValue& value) {
                    job.scene.parameters[name] = scene_parameter(value);
                },
            .get = [scene_name = scene.name, parameter](const Job& job) -> std::optional<JobValue> {
                const auto found = job.scene.parameters.find(parameter.name);
                if (job.scene.builtin != scene_name || found == job.scene.parameters.end()) {
                    return std::nullopt;
                }
                return job_value(parameter, found->second);
            },
            .example = {}};
}

std::vector<KeySpec> parameter_keys()
{
    std::vector<KeySpec> specs;
    for (const BuiltinScene& scene : builtin_scenes()) {
        for (const BuiltinParameter& parameter : scene.parameters) {
            specs.push_back(parameter_key(scene, parameter));
        }
    }
    return specs;
}

CameraSettings& camera_of(Job& job)
{
    return job.camera ? *job.camera : job.camera.emplace();
}
LightSettings& light_of(Job& job)
{
    return job.light ? *job.light : job.light.emplace();
}

KeySpec camera_vector_key(JobKey key, bool zero_allowed, Vec3d CameraSettings::*member)
{
    return {
        .key = std::move(key),
        .domain = VectorDomain{zero_allowed},
        .set = [member](Job& job,
                        const JobValue& value) { camera_of(job).*member = std::get<Vec3d>(value); },
        .get = [member](const Job& job) -> std::optional<JobValue> {
            return job.camera ? held((*job.camera).*member) : std::nullopt;
        },
        .example = {}};
}

/// A key that chooses the projection by being there.
KeySpec projection_key(JobKey key, RealDomain domain, Projection projection,
                       double CameraSettings::*member)
{
    return {.key = std::move(key),
            .domain = domain,
            .set =
                [projection, member](Job& job, const JobValue& value) {
                    camera_of(job).projection = projection;
                    camera_of(job).*member = std::get<double>(value);
                },
            .get = [projection, member](const Job& job) -> std::optional<JobValue> {
                if (!job.camera || job.camera->projection != projection) {
                    return std::nullopt;
                }
                return held((*job.camera).*member);
            },
            .example = {}};
}

std::vector<KeySpec> camera_keys()
{
    return {camera_vector_key(make_key("camera.eye", "where the camera stands [{unit}]",
                                       "[0, 2, 6]", camera_stages, "m"),
                              true, &CameraSettings::eye),
            camera_vector_key(make_key("camera.target", "the point in the image's middle [{unit}]",
                                       "[0, 0.5, 0]", camera_stages, "m"),
                              true, &CameraSettings::target),
            camera_vector_key(make_key("camera.up", "the way that is up in the image", "[0, 1, 0]",
                                       camera_stages),
                              false, &CameraSettings::up),
            projection_key(make_key("camera.vertical_fov_deg",
                                    "perspective: the image's opening angle from top to bottom "
                                    "[{unit}]",
                                    "45", camera_stages, "deg"),
                           opening_angle_deg, Projection::perspective,
                           &CameraSettings::vertical_fov_deg),
            projection_key(make_key("camera.orthographic_height",
                                    "orthographic, in place of vertical_fov_deg: the image's "
                                    "height in the world [{unit}]",
                                    "4", camera_stages, "m"),
                           RealDomain{.lower = 1e-6, .upper = farthest_m}, Projection::orthographic,
                           &CameraSettings::orthographic_height_m)};
}

std::vector<KeySpec> image_keys()
{
    return {member_key<std::int64_t>(
                make_key("image.width", "columns [{unit}]", "1280", camera_stages, "px"),
                IntegerDomain{1, largest_side},
                [](auto& job) -> auto& { return job.image.width_px; }),
            member_key<std::int64_t>(
                make_key("image.height", "rows [{unit}]", "720", camera_stages, "px"),
                IntegerDomain{1, largest_side},
                [](auto& job) -> auto& { return job.image.height_px; })};
}

KeySpec light_type_key()
{
    return {.key = make_key("light.type", "the kind of light", "\"directional\"", light_stages),
            .domain = WordDomain{{"directional", "spot", "point"}},
            .set =
                [](Job& job, const JobValue& value) {
                    LightType& type = light_of(job).type;
                    type = LightType::directional;
                    for (const LightType other : {LightType::spot, LightType::point}) {
                        if (std::get<std::string>(value) == light_type_name(other)) {
                            type = other;
                        }
                    }
                },
            .get = [](const Job& job) -> std::optional<JobValue> {
                if (!job.light) {
                    return std::nullopt;
                }
                return held(std::string{light_type_name(job.light->type)});
            },
            .example = {}};
}

KeySpec light_vector_key(JobKey key, bool zero_allowed, std::optional<Vec3d> LightSettings::*member,
                         std::string example)
{
    return {
        .key = std::move(key),
        .domain = VectorDomain{zero_allowed},
        .set = [member](Job& job,
                        const JobValue& value) { light_of(job).*member = std::get<Vec3d>(value); },
        .get = [member](const Job& job) -> std::optional<JobValue> {
            if (!job.light || !((*job.light).*member)) {
                return std::nullopt;
            }
            return held(*((*job.light).*member));
        },
        .example = std::move(example)};
}

KeySpec cone_key()
{
    return {.key = make_key("light.cone_deg", "spot: the cone's full opening angle [{unit}]", "60",
                            light_stages, "deg"),
            .domain = opening_angle_deg,
            .set = [](Job& job,
                      const JobValue& value) { light_of(job).cone_deg = std::get<double>(value); },
            .get = [](const Job& job) -> std::optional<JobValue> {
                if (!job.light || job.light->type != LightType::spot) {
                    return std::nullopt;
                }
                return held(job.light->cone_deg);
            },
            .example = {}};
}

std::vector<KeySpec> light_keys()
{
    return {
        light_type_key(),
        light_vector_key(make_key("light.direction", "directional: the way the light travels",
                                  "[-0.4, -1, -0.3]", light_stages),
                         false, &LightSettings::direction, {}),
        light_vector_key(make_key("light.position",
                                  "spot, point: where it stands [{unit}]; directional: where its "
                                  "camera stands",
                                  "", light_stages, "m"),
                         true, &LightSettings::position, "[4, 6, 4]"),
        light_vector_key(make_key("light.target",
                                  "spot: the point it looks at [{unit}]; directional: with "
                                  "position, in place of direction",
                                  "", light_stages, "m"),
                         true, &LightSettings::target, "[0, 0, 0]"),
        cone_key()};
}

} // namespace

std::vector<KeySpec> look_key_specs()
{
    std::vector<KeySpec> specs;
    for (const auto& group :
         {scene_keys(), parameter_keys(), camera_keys(), image_keys(), light_keys()}) {
        specs.insert(specs.end(), group.begin(), group.end());
    }
    return specs;
}

JobKey make_key(std::string name, std::string description, std::string default_text, Stages stages,
                std::string unit)
{
    constexpr std::string_view place = "{unit}";
    if (const auto found = description.find(place); found != std::string::npos) {
        description.replace(found, place.size(), unit);
    }
    return {std::move(name), std::move(description), std::move(unit), std::move(default_text), {},
            stages};
}

std::string_view key_leaf(std::string_view name)
{
    return name.substr(name.rfind('.') + 1); // rfind gives npos, and npos + 1 = 0, without a dot
}

std::string parameter_prefix(std::string_view builtin)
{
    return fmt::format("scene.{}.", builtin);
}

} // namespace gnomon::scene
