#include "api/scene.hpp"

#include "methods/key_table.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>
#include <utility>

namespace gnomon::python {
namespace {

using api::Scene;
using scene::InputError;
using scene::Vec3d;

using Indices = api::TriangleIndices;

/// Converts indices of any integer type.
std::vector<Indices> indices_of(const py::object& given, std::size_t vertex_count)
{
    const py::array array = py::array::ensure(given);
    if (!array || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
        throw InputError("triangles must be an array of integers: indices of vertices");
    }
    const auto wide = numbers_of<std::int64_t>(given, "triangles");
    if (wide.ndim() != 2 || wide.shape(1) != 3) {
        throw InputError("triangles must have the shape (n, 3)");
    }
    std::vector<Indices> triangles(static_cast<std::size_t>(wide.shape(0)));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t index =
                wide.at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k));
            if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count) {
                throw InputError(fmt::format("triangles[{}, {}] is {}: there are {} vertices", i, k,
                                             index, vertex_count));
            }
            triangles[i][k] = static_cast<std::uint32_t>(index);
        }
    }
    return triangles;
}

/// A scene, and which of the given triangles it kept.
py::tuple make_scene(const py::object& vertices, const py::object& triangles,
                     const std::vector<std::pair<std::string, std::int64_t>>& objects,
                     const std::vector<std::string>& no_cast,
                     const std::vector<std::string>& no_receive)
{
    const auto corners = vectors_of<Vec3d, 3>(vertices, "vertices");
    const auto indices = indices_of(triangles, corners.size());
    std::vector<api::NamedTriangles> named;
    for (const auto& [name, count] : objects) {
        named.push_back({name, count});
    }
    api::ArrayScene built;
    {
        const py::gil_scoped_release released;
        built = api::make_array_scene(corners, indices, std::move(named), no_cast, no_receive);
    }
    return py::make_tuple(
        std::move(built.scene),
        py::array_t<std::uint32_t>(static_cast<py::ssize_t>(built.kept.size()), built.kept.data()));
}

/// Loads the scene that a job names.
std::shared_ptr<Scene> load(const std::string& path, const std::string& builtin,
                            const std::vector<std::pair<std::string, std::string>>& keys)
{
    const py::gil_scoped_release released;
    std::vector<scene::Override> overrides;
    for (const auto& [key, value] : keys) {
        overrides.push_back({key, value, {}});
    }
    const scene::Job job = builtin.empty()
                               ? scene::read_job(path, overrides, {}, methods::key_table()).job
                               : scene::builtin_job(builtin, overrides, methods::key_table()).job;
    return std::make_shared<Scene>(job.scene);
}

py::list objects_of(const Scene& scene)
{
    py::list objects;
    for (const scene::Object& object : scene.triangles().objects) {
        objects.append(py::make_tuple(object.name, object.first_triangle, object.triangle_count,
                                      object.casts, object.receives));
    }
    return objects;
}

} // namespace

void bind_scene(py::module_& module)
{
    py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene")
        .def_property_readonly(
            "vertices",
            [](py::object self) {
                const auto& vertices = self.cast<const Scene&>().triangles().vertices;
                return view_of(&vertices.data()->x, {static_cast<py::ssize_t>(vertices.size()), 3},
                               self);
            })
        .def_property_readonly(
            "triangles",
            [](py::object self) {
                const auto& triangles = self.cast<const Scene&>().triangles().triangles;
                return view_of(triangles.data()->data(),
                               {static_cast<py::ssize_t>(triangles.size()), 3}, self);
            })
        .def_property_readonly("objects", &objects_of)
        .def_property_readonly("north",
                               [](const Scene& self) {
                                   const Vec3d& north = self.north();
                                   return py::make_tuple(north.x, north.y, north.z);
                               })
        .def_property_readonly("dropped_triangles",
                               [](const Scene& self) { return self.triangles().dropped_triangles; })
        .def_property_readonly("content_hash", [](const Scene& self) {
            return scene::content_hash(self.triangles());
        });
    module.def("make_scene", &make_scene);
    module.def("load", &load);
}

} // namespace gnomon::python
