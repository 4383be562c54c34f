#include "api/gnomon.h"
#include "api/mask.hpp"
#include "api/scene.hpp"
#include "methods/key_table.hpp"
#include "reference_rt/points/point_truth.hpp"
#include "reports/json/comparison_json.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

struct gnomon_scene {
    std::shared_ptr<const gnomon::api::Scene> scene;
    std::optional<std::vector<std::uint32_t>> kept;
};

struct gnomon_evaluation {
    gnomon::api::EvaluatedMask evaluated;
    std::string json;
};

namespace {

namespace api = gnomon::api;
namespace methods = gnomon::methods;
namespace reference_rt = gnomon::reference_rt;
namespace reports = gnomon::reports;
namespace scene = gnomon::scene;

using scene::InputError;
using scene::Vec2d;
using scene::Vec3d;

std::string& last_error()
{
    thread_local std::string text;
    return text;
}

/// Runs a call and converts its exceptions to a status.
template <typename Call>
gnomon_status guarded(const Call& call)
{
    const auto failed = [](gnomon_status status, const char* text) {
        last_error() = scene::one_line(text);
        return status;
    };
    try {
        call();
        return GNOMON_OK;
    } catch (const InputError& error) {
        return failed(GNOMON_BAD_INPUT, error.what());
    } catch (const scene::EnvironmentError& error) {
        return failed(GNOMON_ENVIRONMENT, error.what());
    } catch (const std::bad_alloc&) {
        return failed(GNOMON_ENVIRONMENT, "out of memory");
    } catch (const std::exception& error) {
        return failed(GNOMON_INTERNAL, error.what());
    }
}

template <typename Pointer>
void require(Pointer pointer, const char* argument, std::size_t count = 1)
{
    if (pointer == nullptr && count > 0) {
        throw InputError(fmt::format("{} is null", argument));
    }
}

void require_threads(int threads)
{
    if (threads < 0 || threads > 1024) {
        throw InputError(fmt::format("threads = {}: must be 0 to 1024", threads));
    }
}

Vec3d vector(const double (&numbers)[3])
{
    return {numbers[0], numbers[1], numbers[2]};
}

/// Converts three numbers per vector.
std::vector<Vec3d> vectors(const double* numbers, std::size_t count)
{
    std::vector<Vec3d> made(count);
    for (std::size_t i = 0; i < count; ++i) {
        made[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    return made;
}

scene::LightSettings settings_of(const gnomon_light& light)
{
    scene::LightSettings settings;
    switch (light.kind) {
    case GNOMON_DIRECTIONAL:
        settings.type = scene::LightType::directional;
        settings.direction = vector(light.direction);
        return settings;
    case GNOMON_POINT:
        settings.type = scene::LightType::point;
        settings.position = vector(light.position);
        return settings;
    case GNOMON_SPOT:
        settings.type = scene::LightType::spot;
        settings.position = vector(light.position);
        settings.target = vector(light.target);
        settings.cone_deg = light.cone_deg;
        if (!(light.cone_deg > 0 && light.cone_deg < 180)) {
            throw InputError(
                fmt::format("light.cone_deg = {}: must be above 0 and below 180", light.cone_deg));
        }
        return settings;
    }
    throw InputError(fmt::format("light.kind = {}: unknown kind", light.kind));
}

void require_finite(const scene::LightSettings& light)
{
    for (const auto& [name, value] : {std::pair{"direction", light.direction},
                                      {"position", light.position},
                                      {"target", light.target}}) {
        for (int axis = 0; value && axis < 3; ++axis) {
            if (!(std::abs((*value)[axis]) <= scene::max_coordinate_m)) {
                throw InputError(fmt::format("light.{}: {} is {}: must be finite and within ±1e15",
                                             name, "xyz"[axis], (*value)[axis]));
            }
        }
    }
}

scene::Light light_of(const gnomon_light& light)
{
    const scene::LightSettings settings = settings_of(light);
    require_finite(settings);
    return light.keeps_doubles != 0 ? api::make_light_of_doubles(settings)
                                    : scene::make_light(settings);
}

std::vector<scene::Override> keys_of(const gnomon_light& light)
{
    const scene::LightSettings settings = settings_of(light);
    require_finite(settings);
    std::vector<scene::Override> keys{
        {"light.type", std::string{scene::light_type_name(settings.type)}, {}}};
    for (const auto& [key, value] : {std::pair{"light.direction", settings.direction},
                                     {"light.position", settings.position},
                                     {"light.target", settings.target}}) {
        if (value) {
            keys.push_back({key,
                            fmt::format("[{}, {}, {}]", scene::toml_number(value->x),
                                        scene::toml_number(value->y), scene::toml_number(value->z)),
                            {}});
        }
    }
    if (scene::has_cone(settings.type)) {
        keys.push_back({"light.cone_deg", scene::toml_number(settings.cone_deg), {}});
    }
    return keys;
}

void copy_truth(const scene::PointTruth& found, const gnomon_truth& truth)
{
    for (std::size_t i = 0; i < found.point_class.size(); ++i) {
        if (truth.classes != nullptr) {
            truth.classes[i] = static_cast<std::uint8_t>(found.point_class[i]);
        }
        if (truth.witness != nullptr) {
            truth.witness[i] = found.witness[i];
        }
        if (truth.share != nullptr) {
            const scene::LightShare share = found.share(i);
            truth.share[2 * i] = share.lo;
            truth.share[2 * i + 1] = share.hi;
        }
    }
}

template <typename Pixel, typename Number>
scene::Image<Pixel> image_of(const gnomon_mask& mask, const Number* numbers)
{
    if (numbers == nullptr) {
        return {};
    }
    static_assert(sizeof(Pixel) % sizeof(Number) == 0);
    scene::Image<Pixel> image{scene::ImageSize{mask.width, mask.height}};
    std::memcpy(image.data(), numbers, image.pixel_count() * sizeof(Pixel));
    return image;
}

void require_sound(const gnomon_mask& mask)
{
    constexpr int largest_side = 16384;
    if (mask.width < 1 || mask.height < 1 || mask.width > largest_side ||
        mask.height > largest_side) {
        throw InputError(fmt::format("mask: {} × {} pixels: must be 1 to {} on each side",
                                     mask.width, mask.height, largest_side));
    }
    require(mask.values, "mask.values");
    require(mask.positions, "mask.positions");
    if (!(mask.tolerance >= 0)) {
        throw InputError(fmt::format("mask.tolerance = {}: must be 0 or more", mask.tolerance));
    }
}

} // namespace

const char* gnomon_version()
{
    return GNOMON_VERSION;
}

const char* gnomon_last_error()
{
    return last_error().c_str();
}

gnomon_status gnomon_scene_from_arrays(const double* vertices, size_t vertex_count,
                                       const uint32_t* triangles, size_t triangle_count,
                                       gnomon_scene** scene)
{
    return guarded([&] {
        require(scene, "scene");
        require(vertices, "vertices", vertex_count);
        require(triangles, "triangles", triangle_count);
        std::vector<api::TriangleIndices> indices(triangle_count);
        for (std::size_t i = 0; i < triangle_count; ++i) {
            indices[i] = {triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]};
        }
        api::ArrayScene made = api::make_array_scene(vectors(vertices, vertex_count), indices);
        *scene = new gnomon_scene{std::move(made.scene), std::move(made.kept)};
    });
}

gnomon_status gnomon_scene_load(const char* path, gnomon_scene** scene)
{
    return guarded([&] {
        require(scene, "scene");
        require(path, "path");
        const scene::Job job = scene::read_job(path, {}, {}, methods::key_table()).job;
        *scene = new gnomon_scene{std::make_shared<const api::Scene>(job.scene), std::nullopt};
    });
}

void gnomon_scene_free(gnomon_scene* scene)
{
    delete scene;
}

size_t gnomon_scene_triangle_count(const gnomon_scene* scene)
{
    return scene == nullptr ? 0 : scene->scene->triangles().triangles.size();
}

const uint32_t* gnomon_scene_kept_triangles(const gnomon_scene* scene)
{
    return scene == nullptr || !scene->kept ? nullptr : scene->kept->data();
}

gnomon_status gnomon_truth_in_space(const gnomon_scene* scene, const gnomon_light* light,
                                    const double* points, size_t count, int threads,
                                    gnomon_truth truth)
{
    return guarded([&] {
        require(scene, "scene");
        require(light, "light");
        require(points, "points", count);
        require_threads(threads);
        copy_truth(reference_rt::find_point_truth(scene->scene->reference(), light_of(*light),
                                                  vectors(points, count), {threads, {}}),
                   truth);
    });
}

gnomon_status gnomon_truth_on_triangles(const gnomon_scene* scene, const gnomon_light* light,
                                        const uint32_t* triangles, const double* barycentrics,
                                        size_t count, int side, int threads, gnomon_truth truth)
{
    return guarded([&] {
        require(scene, "scene");
        require(light, "light");
        require(triangles, "triangles", count);
        require(barycentrics, "barycentrics", count);
        require_threads(threads);
        constexpr std::array sides{scene::PointSide::to_light, scene::PointSide::front,
                                   scene::PointSide::back};
        if (side < 0 || side >= static_cast<int>(sides.size())) {
            throw InputError(fmt::format("side = {}: unknown side", side));
        }
        std::vector<Vec2d> places(count);
        for (std::size_t i = 0; i < count; ++i) {
            places[i] = {barycentrics[2 * i], barycentrics[2 * i + 1]};
        }
        copy_truth(reference_rt::find_point_truth(
                       scene->scene->reference(), light_of(*light),
                       scene::SurfacePoints{
                           {triangles, count}, places, sides.at(static_cast<std::size_t>(side))},
                       {threads, {}}),
                   truth);
    });
}

gnomon_status gnomon_evaluate(const gnomon_scene* scene, const gnomon_light* light,
                              const gnomon_mask* mask, int threads, gnomon_evaluation** evaluation)
{
    return guarded([&] {
        require(scene, "scene");
        require(light, "light");
        require(mask, "mask");
        require(evaluation, "evaluation");
        require_threads(threads);
        require_sound(*mask);
        if (light->keeps_doubles != 0) {
            throw InputError(
                "light.keeps_doubles: must be 0 for a mask, whose light is rounded to float32");
        }
        api::Mask given;
        given.values = image_of<float>(*mask, mask->values);
        given.positions = image_of<scene::Vec3f>(*mask, mask->positions);
        given.normals = image_of<scene::Vec3f>(*mask, mask->normals);
        if (mask->eye != nullptr) {
            given.eye = Vec3d{mask->eye[0], mask->eye[1], mask->eye[2]};
        }
        given.has_fractions = mask->has_fractions != 0;
        given.keys = keys_of(*light);
        if (mask->tolerance > 0) {
            given.tolerance_m = mask->tolerance;
        }
        api::EvaluatedMask evaluated = api::evaluate(*scene->scene, std::move(given), threads);
        std::string json = reports::comparison_json(evaluated.comparison);
        *evaluation = new gnomon_evaluation{std::move(evaluated), std::move(json)};
    });
}

const char* gnomon_evaluation_json(const gnomon_evaluation* evaluation)
{
    return evaluation == nullptr ? "" : evaluation->json.c_str();
}

const uint8_t* gnomon_evaluation_classes(const gnomon_evaluation* evaluation)
{
    static_assert(sizeof(scene::PixelClass) == 1);
    return evaluation == nullptr ? nullptr
                                 : reinterpret_cast<const uint8_t*>(
                                       evaluation->evaluated.comparison.truth.pixel_class.data());
}

void gnomon_evaluation_free(gnomon_evaluation* evaluation)
{
    delete evaluation;
}
