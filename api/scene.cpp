#include "api/scene.hpp"

#include "scene/error.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/load/load_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace gnomon::api {

Scene::Scene(const scene::SceneSettings& settings)
    : file_{scene::load_scene(settings)},
      north_{settings.north.value_or(scene::usual_north)}
{
}

Scene::Scene(scene::TriangleScene triangles) : file_{std::move(triangles), {}} {}

const reference_rt::ReferenceScene& Scene::reference() const
{
    std::call_once(reference_made_, [&] {
        reference_ = std::make_unique<const reference_rt::ReferenceScene>(file_.scene);
    });
    return *reference_;
}

namespace {

using scene::InputError;
using scene::Vec3d;

void require_finite(std::span<const Vec3d> vertices)
{
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(vertices[i][axis]) <= scene::max_coordinate_m)) {
                throw InputError(fmt::format("vertices[{}]: {} is {}: coordinates must be finite "
                                             "and within ±1e15",
                                             i, "xyz"[axis], vertices[i][axis]));
            }
        }
    }
}

void require_vertices(std::span<const TriangleIndices> triangles, std::size_t vertex_count)
{
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangles[i][k] >= vertex_count) {
                throw InputError(fmt::format("triangles[{}, {}] is {}: there are {} vertices", i, k,
                                             triangles[i][k], vertex_count));
            }
        }
    }
}

/// Requires the objects to cover every triangle.
void require_all(const std::vector<NamedTriangles>& objects, std::size_t triangle_count)
{
    std::int64_t held = 0;
    for (const auto& [name, count] : objects) {
        if (count < 0) {
            throw InputError(fmt::format("objects: \"{}\" has {} triangles", name, count));
        }
        held += count;
    }
    if (static_cast<std::size_t>(held) != triangle_count) {
        throw InputError(fmt::format("objects cover {} of {} triangles: they must cover all", held,
                                     triangle_count));
    }
}

/// Adds an object with only the vertices that it uses.
/// @return  Indices of its triangles that have an area.
std::vector<std::uint32_t> add(scene::SceneBuilder& builder, const std::string& name,
                               std::span<const Vec3d> vertices,
                               std::span<const TriangleIndices> triangles)
{
    std::vector<Vec3d> own;
    std::vector<TriangleIndices> own_triangles;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const TriangleIndices& triangle : triangles) {
        TriangleIndices& numbered = own_triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [number, is_new] =
                numbers.try_emplace(triangle[k], static_cast<std::uint32_t>(own.size()));
            if (is_new) {
                own.push_back(vertices[triangle[k]]);
            }
            numbered[k] = number->second;
        }
    }
    return builder.add(name, own, own_triangles);
}

} // namespace

ArrayScene make_array_scene(std::span<const Vec3d> vertices,
                            std::span<const TriangleIndices> triangles,
                            std::vector<NamedTriangles> objects,
                            const std::vector<std::string>& no_cast,
                            const std::vector<std::string>& no_receive)
{
    require_finite(vertices);
    require_vertices(triangles, vertices.size());
    if (objects.empty()) {
        objects.push_back({"mesh", static_cast<std::int64_t>(triangles.size())});
    }
    require_all(objects, triangles.size());
    ArrayScene made;
    scene::SceneBuilder builder;
    std::size_t first = 0;
    for (const auto& [name, signed_count] : objects) {
        const auto count = static_cast<std::size_t>(signed_count);
        for (const std::uint32_t triangle :
             add(builder, name, vertices, triangles.subspan(first, count))) {
            made.kept.push_back(static_cast<std::uint32_t>(first) + triangle);
        }
        first += count;
    }
    scene::TriangleScene built = builder.take();
    if (built.triangles.empty()) {
        throw InputError("triangles: no triangle has an area");
    }
    scene::set_roles(built, no_cast, no_receive);
    made.scene = std::make_shared<Scene>(std::move(built));
    return made;
}

scene::Light make_light_of_doubles(const scene::LightSettings& settings)
{
    scene::Light light = scene::make_light(settings);
    if (light.has_position()) {
        light.position = *settings.position;
    }
    if (settings.direction) {
        light.direction = *settings.direction;
    } else if (settings.target) {
        light.direction = *settings.target - settings.position.value_or(scene::Vec3d{0.0});
    }
    return light;
}

} // namespace gnomon::api
