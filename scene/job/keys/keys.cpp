#include "scene/job/keys/keys.hpp"

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

Key builtin_key()
{
    WordDomain names;
    for (const BuiltinScene& scene : builtin_scenes()) {
        names.words.push_back(scene.name);
    }
    Key spec = member_key<std::string>(
        make_key("scene.builtin", "a built-in scene, or file instead", "", only_scene),
        std::move(names), [](auto& job) -> auto& { return job.scene.builtin; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        return job.scene.builtin.empty() ? std::nullopt : held(job.scene.builtin);
    };
    spec.example = "\"sphere-cube\"";
    return spec;
}

Key file_key()
{
    return job_key(
        make_key("scene.file", "a .gltf, .glb, .obj or .ply file, relative to the job file", "",
                 only_scene),
        TextDomain{},
        [](Job& job, const JobValue& value) { job.scene.file = std::get<std::string>(value); },
        [](const Job& job) -> std::optional<JobValue> {
            return job.scene.file.empty() ? std::nullopt : held(job.scene.file.string());
        },
        "\"bunny.obj\"");
}

/// Expands one job to several (`JobSource`) and is not part of any of them.
Key scene_lights_key()
{
    return job_key(
        make_key("scene.lights",
                 "which lights of the file are used where the job gives none: the first, "
                 "or each as one of several",
                 "\"first\"", only_scene),
        WordDomain{.words = {"first", "all"}}, [](Job&, const JobValue&) {},
        [](const Job&) -> std::optional<JobValue> { return std::nullopt; });
}

Key unit_key()
{
    return job_key(
        make_key("scene.unit_m",
                 "how long a unit of the file is [{unit}]; without it lengths are taken "
                 "as they are, and called units",
                 "", only_scene, "m"),
        RealDomain{.lower = 1e-9, .upper = 1e9},
        [](Job& job, const JobValue& value) { job.scene.unit_m = std::get<double>(value); },
        [](const Job& job) -> std::optional<JobValue> {
            return job.scene.unit_m ? held(*job.scene.unit_m) : std::nullopt;
        },
        "0.01");
}

/// Omitted for y, so that results from before the key existed keep their identity.
Key up_key()
{
    Key spec = word_key<UpAxis>(
        make_key("scene.up", "which axis of the file points up; z is turned to y", "\"y\"",
                 only_scene),
        2, up_axis_name, [](auto& job) -> auto& { return job.scene.up; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        return job.scene.up == UpAxis::y ? std::nullopt
                                         : held(std::string{up_axis_name(job.scene.up)});
    };
    return spec;
}

Key north_key()
{
    return job_key(
        make_key(
            "scene.north",
            "which way is north, for light.sun: its horizontal part; without it [0, 0, -1], so "
            "that x points east",
            "", light_stages),
        VectorDomain{.zero_allowed = false},
        [](Job& job, const JobValue& value) { job.scene.north = std::get<Vec3d>(value); },
        [](const Job& job) -> std::optional<JobValue> {
            return job.scene.north ? held(*job.scene.north) : std::nullopt;
        },
        "[0, 0, -1]");
}

std::vector<Key> scene_keys()
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
                TextListDomain{}, [](auto& job) -> auto& { return job.scene.no_receive; }),
            north_key()};
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

Key parameter_key(const BuiltinScene& scene, const BuiltinParameter& parameter)
{
    return job_key(
        make_key(parameter_prefix(scene.name) + parameter.name,
                 parameter.description + (parameter.unit.empty() ? "" : " [{unit}]"),
                 to_toml(job_value(parameter, parameter.default_value)), only_scene,
                 parameter.unit),
        parameter_domain(parameter),
        [name = parameter.name](Job& job, const JobValue& value) {
            job.scene.parameters[name] = scene_parameter(value);
        },
        [scene_name = scene.name, parameter](const Job& job) -> std::optional<JobValue> {
            const auto found = job.scene.parameters.find(parameter.name);
            if (job.scene.builtin != scene_name || found == job.scene.parameters.end()) {
                return std::nullopt;
            }
            return job_value(parameter, found->second);
        });
}

std::vector<Key> parameter_keys()
{
    std::vector<Key> specs;
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

SunSettings& sun_of(Job& job)
{
    LightSettings& light = light_of(job);
    return light.sun ? *light.sun : light.sun.emplace();
}

Key camera_vector_key(Key key, bool zero_allowed, Vec3d CameraSettings::*member)
{
    return job_key(
        std::move(key), VectorDomain{zero_allowed},
        [member](Job& job, const JobValue& value) {
            camera_of(job).*member = std::get<Vec3d>(value);
        },
        [member](const Job& job) -> std::optional<JobValue> {
            return job.camera ? held((*job.camera).*member) : std::nullopt;
        });
}

/// A key that implies the projection.
Key projection_key(Key key, RealDomain domain, Projection projection,
                   double CameraSettings::*member)
{
    return job_key(
        std::move(key), domain,
        [projection, member](Job& job, const JobValue& value) {
            camera_of(job).projection = projection;
            camera_of(job).*member = std::get<double>(value);
        },
        [projection, member](const Job& job) -> std::optional<JobValue> {
            if (!job.camera || job.camera->projection != projection) {
                return std::nullopt;
            }
            return held((*job.camera).*member);
        });
}

std::vector<Key> camera_keys()
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

std::vector<Key> image_keys()
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

Key light_type_key()
{
    WordDomain names;
    for (const LightType type : light_types) {
        names.words.emplace_back(light_type_name(type));
    }
    return job_key(
        make_key("light.type", "the kind of light", "\"directional\"", light_stages),
        std::move(names),
        [](Job& job, const JobValue& value) {
            light_of(job).type = light_type_from_name(std::get<std::string>(value)).value();
        },
        [](const Job& job) -> std::optional<JobValue> {
            if (!job.light) {
                return std::nullopt;
            }
            return held(std::string{light_type_name(job.light->type)});
        });
}

Key light_vector_key(Key key, bool zero_allowed, std::optional<Vec3d> LightSettings::*member,
                     std::string example)
{
    return job_key(
        std::move(key), VectorDomain{zero_allowed},
        [member](Job& job, const JobValue& value) {
            light_of(job).*member = std::get<Vec3d>(value);
        },
        [member](const Job& job) -> std::optional<JobValue> {
            if (!job.light || !((*job.light).*member)) {
                return std::nullopt;
            }
            return held(*((*job.light).*member));
        },
        std::move(example));
}

Key cone_key()
{
    Key key = job_key(
        make_key("light.cone_deg", "spot: the cone's full opening angle [{unit}]", "60",
                 light_stages, "deg"),
        opening_angle_deg,
        [](Job& job, const JobValue& value) { light_of(job).cone_deg = std::get<double>(value); },
        [](const Job& job) { return job.light ? held(job.light->cone_deg) : std::nullopt; });
    return of_lights(std::move(key), {LightType::spot});
}

Key sun_number_key(Key key, double most_deg, double SunSettings::*member, std::string example)
{
    Key spec = job_key(
        std::move(key), RealDomain{.lower = -most_deg, .upper = most_deg},
        [member](Job& job, const JobValue& value) {
            sun_of(job).*member = std::get<double>(value);
        },
        [member](const Job& job) -> std::optional<JobValue> {
            return job.light && job.light->sun ? held((*job.light->sun).*member) : std::nullopt;
        },
        std::move(example));
    return of_lights(std::move(spec), {LightType::directional});
}

Key sun_time_key()
{
    Key spec = job_key(
        make_key("light.sun.time", "the time at that place, in UTC or with an offset", "",
                 light_stages),
        TimeDomain{},
        [](Job& job, const JobValue& value) { sun_of(job).time = std::get<std::string>(value); },
        [](const Job& job) -> std::optional<JobValue> {
            return job.light && job.light->sun ? held(job.light->sun->time) : std::nullopt;
        },
        "\"2026-06-21T12:00:00Z\"");
    return of_lights(std::move(spec), {LightType::directional});
}

std::vector<Key> light_keys()
{
    return {
        light_type_key(),
        of_lights(
            light_vector_key(make_key("light.direction", "directional: the way the light travels",
                                      "[-0.4, -1, -0.3]", light_stages),
                             false, &LightSettings::direction, {}),
            {LightType::directional}),
        light_vector_key(make_key("light.position",
                                  "spot, point: where it stands [{unit}]; directional: where its "
                                  "camera stands",
                                  "", light_stages, "m"),
                         true, &LightSettings::position, "[4, 6, 4]"),
        of_lights(light_vector_key(make_key("light.target",
                                            "spot: the point it looks at [{unit}]; directional: "
                                            "with position, in place of direction",
                                            "", light_stages, "m"),
                                   true, &LightSettings::target, "[0, 0, 0]"),
                  {LightType::directional, LightType::spot}),
        cone_key(),
        sun_number_key(make_key("light.sun.latitude_deg",
                                "in place of direction: the sun over a place, here its latitude "
                                "[{unit}]",
                                "", light_stages, "deg"),
                       90, &SunSettings::latitude_deg, "52.5"),
        sun_number_key(make_key("light.sun.longitude_deg",
                                "the longitude of that place, east of Greenwich [{unit}]", "",
                                light_stages, "deg"),
                       180, &SunSettings::longitude_deg, "13.4"),
        sun_time_key()};
}

} // namespace

Key job_key(Key key, Domain domain, std::function<void(Job&, const JobValue&)> set,
            std::function<std::optional<JobValue>(const Job&)> get, std::string example)
{
    key.domain = std::move(domain);
    key.set = std::move(set);
    key.get = std::move(get);
    key.example = std::move(example);
    return key;
}

Key of_lights(Key key, std::vector<LightType> lights)
{
    key.lights = std::move(lights);
    key.get = [get = std::move(key.get),
               lights = key.lights](const Job& job) -> std::optional<JobValue> {
        const bool is_other =
            job.light && std::ranges::find(lights, job.light->type) == lights.end();
        return is_other ? std::nullopt : get(job);
    };
    return key;
}

std::vector<Key> look_keys()
{
    std::vector<Key> specs;
    for (const auto& group :
         {scene_keys(), parameter_keys(), camera_keys(), image_keys(), light_keys()}) {
        specs.insert(specs.end(), group.begin(), group.end());
    }
    return specs;
}

std::string parameter_prefix(std::string_view builtin)
{
    return fmt::format("scene.{}.", builtin);
}

} // namespace gnomon::scene
