#include "reference_rt/rounded/nearest_surface.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gnomon::reference_rt {

using scene::NearestSurface;
using scene::no_object;
using scene::no_triangle;
using scene::SurfaceScope;
using scene::Vec2d;
using scene::Vec3d;

namespace {

/// The fraction of the edge from u to v at its point nearest to `point`.
double nearest_share(const Vec3d& point, const Vec3d& u, const Vec3d& v)
{
    const Vec3d along = v - u;
    return std::clamp(glm::dot(point - u, along) / glm::dot(along, along), 0.0, 1.0);
}

double distance_to_edge(const Vec3d& point, const Vec3d& u, const Vec3d& v)
{
    return glm::length(point - (u + nearest_share(point, u, v) * (v - u)));
}

} // namespace

double distance_m(const Vec3d& point, const Corners& triangle)
{
    const auto& [a, b, c] = triangle;
    const Vec3d normal = glm::cross(b - a, c - a);
    const auto is_inside = [&](const Vec3d& u, const Vec3d& v) {
        return glm::dot(glm::cross(normal, v - u), point - u) >= 0;
    };
    const double length = glm::length(normal);
    if (length > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) {
        return std::abs(glm::dot(normal, point - a)) / length;
    }
    return std::min({distance_to_edge(point, a, b), distance_to_edge(point, b, c),
                     distance_to_edge(point, c, a)});
}

Vec2d nearest_place(const Vec3d& point, const Corners& triangle)
{
    const auto& [a, b, c] = triangle;
    const Vec3d normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    const double u = glm::dot(glm::cross(c - a, a - point), normal) / area;
    const double v = glm::dot(glm::cross(a - point, b - a), normal) / area;
    if (area > 0 && u >= 0 && v >= 0 && u + v <= 1) {
        return {u, v};
    }
    const double ab = nearest_share(point, a, b);
    const double bc = nearest_share(point, b, c);
    const double ca = nearest_share(point, c, a);
    const std::array<Vec2d, 3> places{Vec2d{ab, 0}, {1 - bc, bc}, {0, 1 - ca}};
    return *std::ranges::min_element(places, {}, [&](const Vec2d& place) {
        return glm::length(a + place.x * (b - a) + place.y * (c - a) - point);
    });
}

NearbySurfaces::NearbySurfaces(const ReferenceScene::Implementation& reference)
    : reference_{reference}
{
}

NearestSurface NearbySurfaces::find_nearest(const Vec3d& point, const SurfaceScope& scope)
{
    extent_m_ = 0;
    spread_ = 1;
    gathers_ = false;
    search(point, scope);
    return is_near_enough() ? nearest_ : NearestSurface{};
}

const std::vector<NearbyTriangle>& NearbySurfaces::find_all(const Vec3d& point, double extent_m,
                                                            const SurfaceScope& scope)
{
    extent_m_ = extent_m;
    spread_ = std::numbers::sqrt3;
    gathers_ = true;
    search(point, scope);
    if (!is_near_enough()) {
        found_.clear();
    }
    std::erase_if(found_, [&](const NearbyTriangle& t) { return t.distance_m > reach_m(); });
    std::sort(found_.begin(), found_.end(), [](const NearbyTriangle& a, const NearbyTriangle& b) {
        return a.triangle < b.triangle;
    });
    // The hint is found twice.
    found_.erase(std::unique(found_.begin(), found_.end(),
                             [](const NearbyTriangle& a, const NearbyTriangle& b) {
                                 return a.triangle == b.triangle;
                             }),
                 found_.end());
    return found_;
}

void NearbySurfaces::search(const Vec3d& point, const SurfaceScope& scope)
{
    point_ = point;
    scope_ = scope;
    nearest_ = {};
    found_.clear();
    if (hint_ != no_triangle && is_in_scope(hint_)) {
        consider(hint_);
    }
    const scene::Vec3f origin{reference_.frame.from_world(point)};
    RTCPointQuery query{origin.x, origin.y, origin.z, 0, search_radius()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(reference_.padded.get(), &query, &context, &NearbySurfaces::visit, this);
    hint_ = nearest_.triangle;
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

float NearbySurfaces::search_radius() const
{
    const double reach = reference_.frame.scale() * reach_m();
    if (!std::isfinite(reach)) {
        return std::numeric_limits<float>::infinity();
    }
    // Covers rounding the point to float32, and a few roundings of Embree's squares and sums.
    const double slack = 0x1p-20 * (1 + reach + largest(reference_.frame.from_world(point_)));
    return static_cast<float>(reach + slack);
}

bool NearbySurfaces::visit(RTCPointQueryFunctionArguments* arguments) noexcept
{
    auto& self = *static_cast<NearbySurfaces*>(arguments->userPtr);
    const std::uint32_t triangle = self.reference_.triangle(arguments->geomID, arguments->primID);
    if (!self.is_in_scope(triangle)) {
        return false;
    }
    try {
        self.consider(triangle);
    } catch (...) {
        self.failure_ = std::current_exception();
        return false;
    }
    const float radius = self.search_radius();
    const bool is_narrower = radius < arguments->query->radius;
    if (is_narrower) {
        arguments->query->radius = radius;
    }
    return is_narrower;
}

void NearbySurfaces::consider(std::uint32_t triangle)
{
    const double distance =
        reference_rt::distance_m(point_, corners_of(reference_.triangles, triangle));
    if (distance < nearest_.distance_m ||
        (distance == nearest_.distance_m && triangle < nearest_.triangle)) {
        nearest_ = {triangle, distance};
    }
    if (gathers_ && distance <= reach_m()) {
        found_.push_back({triangle, distance});
    }
}

double NearbySurfaces::reach_m() const
{
    return extent_m_ + spread_ * std::min(nearest_.distance_m, scope_.most_distance_m);
}

bool NearbySurfaces::is_near_enough() const
{
    return nearest_.distance_m <= scope_.most_distance_m;
}

bool NearbySurfaces::is_in_scope(std::uint32_t triangle) const
{
    const auto& objects = reference_.triangles.objects;
    if (scope_.object != no_object) {
        const scene::Object& object = objects[scope_.object];
        return triangle - object.first_triangle < object.triangle_count;
    }
    return objects[reference_.triangles.object_of(triangle)].receives;
}

} // namespace gnomon::reference_rt
