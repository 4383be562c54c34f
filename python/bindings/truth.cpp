#include "reference_rt/points/point_truth.hpp"

#include "api/scene.hpp"
#include "methods/key_table.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"
#include "scene/light/light.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::python {
namespace {

using api::Scene;
using scene::Light;
using scene::LightSettings;
using scene::PointSide;
using scene::PointTruth;
using scene::Vec2d;
using scene::Vec3d;

/// Makes the light of a job's [light] keys.
/// @param keeps_doubles  if false, numbers are rounded to float32 once.
Light light_of(const std::vector<std::pair<std::string, std::string>>& keys, bool keeps_doubles)
{
    const scene::Keys& table = methods::key_table();
    std::vector<scene::Override> overrides{{"scene.file", "scene", {}}}; // a job needs a scene
    for (const auto& [key, value] : keys) {
        overrides.push_back({key, value, {}});
    }
    scene::JobSource source;
    source.keys = table;
    source.name = "light";
    source.file = scene::layer_from_overrides(*table, overrides);
    const LightSettings settings = scene::resolve_light(scene::make_job(source), {});
    return keeps_doubles ? api::make_light_of_doubles(settings) : scene::make_light(settings);
}

reference_rt::PointOptions options_for(int threads)
{
    return {threads, check_signals};
}

std::shared_ptr<PointTruth> truth_in_space(const Scene& scene, const Light& light,
                                           const py::object& points, int threads)
{
    const auto given = vectors_of<Vec3d, 3>(points, "points");
    const py::gil_scoped_release released;
    return std::make_shared<PointTruth>(
        reference_rt::find_point_truth(scene.reference(), light, given, options_for(threads)));
}

/// Converts triangle indices of any integer type.
std::vector<std::uint32_t> triangles_of(const py::object& given, const scene::TriangleScene& scene)
{
    const py::array array = py::array::ensure(given);
    if (array && array.size() == 0) {
        return {};
    }
    if (!array || array.ndim() != 1 ||
        (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
        throw scene::InputError("triangles must be an array of n integers: indices of triangles");
    }
    const auto wide = numbers_of<std::int64_t>(given, "triangles");
    std::vector<std::uint32_t> triangles(static_cast<std::size_t>(wide.shape(0)));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::int64_t index = wide.at(static_cast<py::ssize_t>(i));
        if (index < 0 || static_cast<std::uint64_t>(index) >= scene.triangles.size()) {
            throw scene::InputError(fmt::format("triangles[{}] is {}: the scene has {} triangles",
                                                i, index, scene.triangles.size()));
        }
        triangles[i] = static_cast<std::uint32_t>(index);
    }
    return triangles;
}

PointSide side_of(const std::string& side)
{
    return side == "front"  ? PointSide::front
           : side == "back" ? PointSide::back
                            : PointSide::to_light;
}

std::shared_ptr<PointTruth> truth_on_triangles(const Scene& scene, const Light& light,
                                               const py::object& triangles,
                                               const py::object& barycentrics,
                                               const std::string& side, int threads)
{
    const auto indices = triangles_of(triangles, scene.triangles());
    const auto places = vectors_of<Vec2d, 2>(barycentrics, "barycentrics");
    if (indices.size() != places.size()) {
        throw scene::InputError(fmt::format("{} triangles and {} barycentrics: counts must agree",
                                            indices.size(), places.size()));
    }
    const py::gil_scoped_release released;
    return std::make_shared<PointTruth>(reference_rt::find_point_truth(
        scene.reference(), light, scene::SurfacePoints{indices, places, side_of(side)},
        options_for(threads)));
}

std::shared_ptr<scene::ProjectedPoints> project(const Scene& scene, const py::object& points,
                                                int threads)
{
    const auto given = vectors_of<Vec3d, 3>(points, "points");
    const py::gil_scoped_release released;
    return std::make_shared<scene::ProjectedPoints>(
        reference_rt::project_points(scene.reference(), given, options_for(threads)));
}

/// n × 2: the interval of each point's visible share of the light.
py::array shares_of(const PointTruth& truth)
{
    const auto count = static_cast<py::ssize_t>(truth.point_class.size());
    py::array_t<float> shares{{count, py::ssize_t{2}}};
    auto numbers = shares.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < count; ++i) {
        const scene::LightShare share = truth.share(static_cast<std::size_t>(i));
        numbers(i, 0) = share.lo;
        numbers(i, 1) = share.hi;
    }
    return shares;
}

} // namespace

void bind_truth(py::module_& module)
{
    py::class_<Light>(module, "Light").def(py::init(&light_of));
    py::class_<PointTruth, std::shared_ptr<PointTruth>>(module, "PointTruth")
        .def_property_readonly("point_class",
                               [](py::object self) {
                                   const auto& classes = self.cast<const PointTruth&>().point_class;
                                   return view_of(
                                       reinterpret_cast<const std::uint8_t*>(classes.data()),
                                       {static_cast<py::ssize_t>(classes.size())}, self);
                               })
        .def_property_readonly("reason",
                               [](py::object self) {
                                   const auto& reasons = self.cast<const PointTruth&>().reason;
                                   return view_of(
                                       reinterpret_cast<const std::uint8_t*>(reasons.data()),
                                       {static_cast<py::ssize_t>(reasons.size())}, self);
                               })
        .def_property_readonly(
            "witness",
            [](py::object self) { return view_of(self.cast<const PointTruth&>().witness, self); })
        .def_property_readonly("exact_signs",
                               [](const PointTruth& self) { return self.signs.exact; })
        .def("shares", &shares_of);
    py::class_<scene::ProjectedPoints, std::shared_ptr<scene::ProjectedPoints>>(module,
                                                                                "ProjectedPoints")
        .def_property_readonly("triangles",
                               [](py::object self) {
                                   return view_of(
                                       self.cast<const scene::ProjectedPoints&>().triangles, self);
                               })
        .def_property_readonly(
            "barycentrics",
            [](py::object self) {
                const auto& places = self.cast<const scene::ProjectedPoints&>().barycentrics;
                return view_of(&places.data()->x, {static_cast<py::ssize_t>(places.size()), 2},
                               self);
            })
        .def_property_readonly("distance_m", [](py::object self) {
            return view_of(self.cast<const scene::ProjectedPoints&>().distance_m, self);
        });
    module.def("truth_in_space", &truth_in_space);
    module.def("truth_on_triangles", &truth_on_triangles);
    module.def("project", &project);
}

} // namespace gnomon::python
