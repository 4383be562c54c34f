#include "reference_rt/points/point_truth.hpp"

#include "api/scene.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"
#include "scene/light/light.hpp"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

namespace gnomon::python {
namespace {

using api::Scene;
using scene::Light;
using scene::LightSettings;
using scene::LightType;
using scene::PointSide;
using scene::PointTruth;
using scene::Vec2d;
using scene::Vec3d;

/// After so many points Python may end the work.
constexpr std::size_t batch = 1 << 17;

/// @throws py::error_already_set  if Ctrl-C was pressed.
void check_signals()
{
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
    }
}

std::optional<Vec3d> vector_of(const std::optional<std::array<double, 3>>& given)
{
    return given ? std::optional{Vec3d{(*given)[0], (*given)[1], (*given)[2]}} : std::nullopt;
}

/// A light whose numbers are float32 values, or doubles as they are.
Light light_of(const std::string& type, const std::optional<std::array<double, 3>>& direction,
               const std::optional<std::array<double, 3>>& position,
               const std::optional<std::array<double, 3>>& target, double cone_deg,
               bool keeps_doubles)
{
    LightSettings settings;
    settings.type = type == "spot"    ? LightType::spot
                    : type == "point" ? LightType::point
                                      : LightType::directional;
    settings.direction = vector_of(direction);
    settings.position = vector_of(position);
    settings.target = vector_of(target);
    settings.cone_deg = cone_deg;
    Light light = scene::make_light(settings);
    if (!keeps_doubles) {
        return light;
    }
    light.direction = settings.direction.value_or(Vec3d{0.0});
    light.position = settings.position.value_or(Vec3d{0.0});
    if (settings.target) {
        light.direction = *settings.target - light.position;
    }
    return light;
}

template <typename Number>
void append(std::vector<Number>& all, const std::vector<Number>& part)
{
    all.insert(all.end(), part.begin(), part.end());
}

/// Asks batch by batch: points are independent of each other.
std::shared_ptr<PointTruth>
truth_of_batches(std::size_t count,
                 const std::function<PointTruth(std::size_t first, std::size_t count)>& ask)
{
    auto truth = std::make_shared<PointTruth>();
    for (std::size_t first = 0; first < count; first += batch) {
        check_signals();
        const PointTruth part = ask(first, std::min(batch, count - first));
        append(truth->point_class, part.point_class);
        append(truth->reason, part.reason);
        append(truth->witness, part.witness);
        truth->signs.filtered += part.signs.filtered;
        truth->signs.exact += part.signs.exact;
    }
    return truth;
}

std::shared_ptr<PointTruth> truth_in_space(const Scene& scene, const Light& light,
                                           const py::object& points, int threads)
{
    const auto given = vectors_of<Vec3d, 3>(points, "points");
    const py::gil_scoped_release released;
    return truth_of_batches(given.size(), [&](std::size_t first, std::size_t count) {
        return reference_rt::find_point_truth(scene.reference(), light,
                                              std::span{given}.subspan(first, count), threads);
    });
}

/// Triangles as they are given, whatever integers they are.
std::vector<std::uint32_t> triangles_of(const py::object& given, const scene::TriangleScene& scene)
{
    const py::array array = py::array::ensure(given);
    if (!array || array.ndim() != 1 ||
        (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
        throw py::type_error("triangles must be an array of n integers: indices of triangles");
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
        throw scene::InputError(fmt::format("there are {} triangles and {} barycentrics: a point "
                                            "has one of each",
                                            indices.size(), places.size()));
    }
    const py::gil_scoped_release released;
    return truth_of_batches(indices.size(), [&](std::size_t first, std::size_t count) {
        return reference_rt::find_point_truth(
            scene.reference(), light,
            scene::SurfacePoints{std::span{indices}.subspan(first, count),
                                 std::span{places}.subspan(first, count), side_of(side)},
            threads);
    });
}

std::shared_ptr<scene::ProjectedPoints> project(const Scene& scene, const py::object& points,
                                                int threads)
{
    const auto given = vectors_of<Vec3d, 3>(points, "points");
    const py::gil_scoped_release released;
    return std::make_shared<scene::ProjectedPoints>(
        reference_rt::project_points(scene.reference(), given, threads));
}

/// n × 2: the interval of the share of the light that each point sees.
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
