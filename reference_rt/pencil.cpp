#include "reference_rt/pencil.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

double sum_of_sizes(const Vec3d& v)
{
    const Vec3d size = glm::abs(v);
    return size.x + size.y + size.z;
}

/// The error of N = a × b in double is below 4u·|a|₁|b|₁, and moves N·(x − o) by at most 6 times as
/// much; of a float's rounding of N and of the offset, see `LanePoints::set`. The last term covers
/// every product that underflows.
float size_of(const Vec3d& normal, const Vec3d& a, const Vec3d& b)
{
    return static_cast<float>(sum_of_sizes(normal) + 0x1p-20 * sum_of_sizes(a) * sum_of_sizes(b)) +
           0x1p-90F;
}

Plane plane_through(const Vec3d& normal, double offset, const Vec3d& a, const Vec3d& b)
{
    return {static_cast<float>(normal.x), static_cast<float>(normal.y),
            static_cast<float>(normal.z), static_cast<float>(offset), size_of(normal, a, b)};
}

struct Edges {
    std::array<Vec3d, 3> along; ///< in unit lengths
    std::array<Vec3d, 3> towards;
};

Edges edges_of(const UnitFrame& frame, const Pencil& pencil, const Corners& corners)
{
    Edges edges;
    for (std::size_t i = 0; i < 3; ++i) {
        edges.along[i] = frame.scale() * (corners[(i + 1) % 3] - corners[i]);
        edges.towards[i] = pencil.towards(corners[i]);
    }
    return edges;
}

EdgePlanes planes_of(const Edges& edges, const std::array<Vec3d, 3>& corner)
{
    EdgePlanes planes;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d normal = glm::cross(edges.along[i], edges.towards[i]);
        planes.edge[i] =
            plane_through(normal, glm::dot(normal, corner[i]), edges.along[i], edges.towards[i]);
    }
    return planes;
}

} // namespace

Pencil::Pencil(const UnitFrame& frame, const scene::Light& light)
    : is_parallel_{light.type == scene::LightType::directional}
{
    if (is_parallel_) {
        direction_ = normalised(-light.direction);
    } else {
        apex_ = light.position;
        scale_ = frame.scale() /
                 std::max(1.0, 2 * std::exp2(std::ilogb(largest(frame.from_world(apex_)))));
    }
}

Pencil::Pencil(const UnitFrame& frame, const scene::Camera& camera)
    : is_parallel_{camera.projection == scene::Projection::orthographic}
{
    if (is_parallel_) {
        direction_ = normalised(-camera.forward);
    } else {
        apex_ = camera.eye;
        scale_ = frame.scale() /
                 std::max(1.0, 2 * std::exp2(std::ilogb(largest(frame.from_world(apex_)))));
    }
}

// The value of a plane at a lane's point is s = fl(N·p − k), with N, p and k rounded to float32 and
// |x − o| <= 1 + |p| for the plane's corner o. With u = 2^-24 it is off by at most |N|₁ times
//     error + u|p|    the point,           u|p|        the normal,
//     3u|p| + u       the sum, and k,      u(1 + |p|)  the last difference,
// where |p| is the largest component; 8u(1 + |p|) is more than all but the first together.
void LanePoints::set(std::size_t lane, const Vec3d& point, double error)
{
    x[lane] = static_cast<float>(point.x);
    y[lane] = static_cast<float>(point.y);
    z[lane] = static_cast<float>(point.z);
    reach[lane] = static_cast<float>(1.01 * (error + 8 * float_roundoff * (1 + largest(point))));
}

EdgePlanes edge_planes(const UnitFrame& frame, const Pencil& pencil, const Corners& corners,
                       bool has_apex_at_origin)
{
    if (has_apex_at_origin) {
        return planes_of(edges_of(frame, pencil, corners), {});
    }
    return planes_of(
        edges_of(frame, pencil, corners),
        {frame.from_world(corners[0]), frame.from_world(corners[1]), frame.from_world(corners[2])});
}

ShadowPlanes shadow_planes(const UnitFrame& frame, const Pencil& pencil, const Corners& corners)
{
    const Edges edges = edges_of(frame, pencil, corners);
    const std::array<Vec3d, 3> corner{frame.from_world(corners[0]), frame.from_world(corners[1]),
                                      frame.from_world(corners[2])};
    ShadowPlanes planes;
    planes.edges = planes_of(edges, corner);
    const Vec3d normal = glm::cross(edges.along[0], edges.along[1]);
    planes.surface =
        plane_through(normal, glm::dot(normal, corner[0]), edges.along[0], edges.along[1]);
    const double height = glm::dot(normal, edges.towards[0]);
    // 10 roundings of terms that are at most this large.
    const double bound = 0x1p-48 * sum_of_sizes(edges.along[0]) * sum_of_sizes(edges.along[1]) *
                         sum_of_sizes(edges.towards[0]);
    planes.light = static_cast<Sign>(height > bound) - static_cast<Sign>(height < -bound);
    return planes;
}

LineVerdicts judge_lines(const LanePoints& points, const EdgePlanes& planes)
{
    const auto& [a, b, c] = planes.edge;
    LineVerdicts verdicts;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const float x = points.x[i];
        const float y = points.y[i];
        const float z = points.z[i];
        const float reach = points.reach[i];
        const float p = a.x * x + a.y * y + a.z * z - a.offset;
        const float q = b.x * x + b.y * y + b.z * z - b.offset;
        const float r = c.x * x + c.y * y + c.z * z - c.offset;
        const float p_error = a.size * reach;
        const float q_error = b.size * reach;
        const float r_error = c.size * reach;
        const int above = static_cast<int>(p > p_error) + static_cast<int>(q > q_error) +
                          static_cast<int>(r > r_error);
        const int below = static_cast<int>(p < -p_error) + static_cast<int>(q < -q_error) +
                          static_cast<int>(r < -r_error);
        const LaneBits bit = LaneBits{1} << i;
        verdicts.inside |= above == 3 || below == 3 ? bit : 0;
        verdicts.outside |= above > 0 && below > 0 ? bit : 0;
    }
    return verdicts;
}

LaneBits certainly_on_side(const LanePoints& points, const Plane& plane, Sign side)
{
    const auto sign = static_cast<float>(side);
    LaneBits lanes = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const float value =
            plane.x * points.x[i] + plane.y * points.y[i] + plane.z * points.z[i] - plane.offset;
        lanes |= sign * value > plane.size * points.reach[i] ? LaneBits{1} << i : 0;
    }
    return lanes;
}

} // namespace gnomon::reference_rt
