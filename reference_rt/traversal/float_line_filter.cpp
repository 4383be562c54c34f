#include "reference_rt/traversal/float_line_filter.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

/// Vector arguments cannot pass between functions for different instruction sets, and debug builds
/// only inline on demand.
#define GNOMON_INLINE [[gnu::always_inline]] inline

/// −1 in lanes where a condition holds, else 0.
using LaneMask = decltype(LaneFloats{} < LaneFloats{});

GNOMON_INLINE LaneBits bits_of(const LaneMask& mask)
{
    constexpr LaneMask bit{1 << 0, 1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                           1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    const LaneMask chosen = mask & bit;
    int bits = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        bits |= chosen[i];
    }
    return static_cast<LaneBits>(bits);
}

/// A double for each plane.
using Planes [[gnu::vector_size(4 * sizeof(double))]] = double;
struct Planes3 {
    Planes x, y, z;
};

GNOMON_INLINE Planes3 cross(const Planes3& a, const Planes3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

GNOMON_INLINE Planes size(const Planes& x)
{
    using Bits [[gnu::vector_size(sizeof(Planes))]] = std::int64_t;
    constexpr std::int64_t without_sign = std::numeric_limits<std::int64_t>::max();
    return reinterpret_cast<Planes>(reinterpret_cast<Bits>(x) & without_sign);
}

GNOMON_INLINE Planes sum_of_sizes(const Planes3& v)
{
    return size(v.x) + size(v.y) + size(v.z);
}

GNOMON_INLINE void store(const Planes& values, std::array<float, 4>& target)
{
    using Narrow [[gnu::vector_size(4 * sizeof(float))]] = float;
    const auto narrow = __builtin_convertvector(values, Narrow);
    std::memcpy(target.data(), &narrow, sizeof(narrow));
}

/// A component of the four planes' corners.
template <int axis>
GNOMON_INLINE Planes component(const Corners& c)
{
    return Planes{c[0][axis], c[1][axis], c[2][axis], c[0][axis]};
}

/// Rotates to the next corners.
GNOMON_INLINE Planes next(const Planes& values)
{
    return __builtin_shufflevector(values, values, 1, 2, 0, 1);
}

} // namespace

RayBundle::RayBundle(const UnitFrame& frame, const scene::Light& light)
    : is_parallel_{!light.has_position()}
{
    if (is_parallel_) {
        direction_ = normalised(-light.direction);
    } else {
        apex_ = light.position;
        scale_ = frame.scale() /
                 std::max(1.0, 2 * std::exp2(std::ilogb(largest(frame.from_world(apex_)))));
    }
}

RayBundle::RayBundle(const UnitFrame& frame, const scene::Camera& camera)
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

GNOMON_WIDEST_VECTORS
void LanePoints::set(const LanePositions& points)
{
    Lanes<float> xs;
    Lanes<float> ys;
    Lanes<float> zs;
    Lanes<float> reaches;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const Vec3d point = points.at(i);
        xs[i] = static_cast<float>(point.x);
        ys[i] = static_cast<float>(point.y);
        zs[i] = static_cast<float>(point.z);
        reaches[i] = reach_of(point, points.error[i]);
    }
    std::memcpy(&x, &xs, sizeof(x));
    std::memcpy(&y, &ys, sizeof(y));
    std::memcpy(&z, &zs, sizeof(z));
    std::memcpy(&reach, &reaches, sizeof(reach));
}

GNOMON_WIDEST_VECTORS
TrianglePlanes make_planes(const UnitFrame& frame, const RayBundle& ray_bundle,
                           const SceneTriangle& s, LaneKind kind)
{
    const Corners& corners = s.corners;
    const Planes3 from{component<0>(corners), component<1>(corners), component<2>(corners)};
    const Planes3 to{next(from.x), next(from.y), next(from.z)};
    const double scale = frame.scale();
    const Planes3 along{scale * (to.x - from.x), scale * (to.y - from.y), scale * (to.z - from.z)};
    const Vec3d& direction = ray_bundle.direction_;
    const Vec3d& apex = ray_bundle.apex_;
    const Planes zero{};
    const Planes3 towards =
        ray_bundle.is_parallel_
            ? Planes3{zero + direction.x, zero + direction.y, zero + direction.z}
            : Planes3{ray_bundle.scale_ * (apex.x - from.x), ray_bundle.scale_ * (apex.y - from.y),
                      ray_bundle.scale_ * (apex.z - from.z)};
    constexpr std::size_t surface = TrianglePlanes::surface;
    Planes3 other = towards; // second direction of the edge planes; the surface uses its next edge
    other.x[surface] = along.x[1];
    other.y[surface] = along.y[1];
    other.z[surface] = along.z[1];
    const Planes3 normal = cross(along, other);
    const Vec3d& centre = frame.centre();
    Planes offset = normal.x * (scale * (from.x - centre.x)) +
                    normal.y * (scale * (from.y - centre.y)) +
                    normal.z * (scale * (from.z - centre.z));
    if (kind == LaneKind::directions) {
        offset = Planes{0, 0, 0, offset[surface]};
    }
    // The error of a × b in double is below 4u|a|₁|b|₁, which moves the plane's value by at most 6
    // times as much, far less than 2^-20 times the lanes' reach. 2^-90 covers underflow.
    const Planes product = sum_of_sizes(along) * sum_of_sizes(other);
    TrianglePlanes planes;
    store(normal.x, planes.x);
    store(normal.y, planes.y);
    store(normal.z, planes.z);
    store(offset, planes.offset);
    store(sum_of_sizes(normal) + 0x1p-20 * product + 0x1p-90, planes.size);
    const double height = normal.x[surface] * towards.x[surface] +
                          normal.y[surface] * towards.y[surface] +
                          normal.z[surface] * towards.z[surface];
    // Ten roundings of terms of at most this size.
    const double bound = 0x1p-48 * product[surface] * sum_of_sizes(towards)[surface];
    planes.towards = static_cast<Sign>(height > bound) - static_cast<Sign>(height < -bound);
    return planes;
}

GNOMON_WIDEST_VECTORS
LineVerdicts judge_lines(const LanePoints& points, const TrianglePlanes& planes)
{
    LaneMask all_above = ~LaneMask{};
    LaneMask all_below = ~LaneMask{};
    LaneMask any_above{};
    LaneMask any_below{};
    for (std::size_t i = 0; i < 3; ++i) {
        const LaneFloats value = planes.x[i] * points.x + planes.y[i] * points.y +
                                 planes.z[i] * points.z - planes.offset[i];
        const LaneFloats error = planes.size[i] * points.reach;
        const LaneMask above = value > error;
        const LaneMask below = value < -error;
        all_above &= above;
        all_below &= below;
        any_above |= above;
        any_below |= below;
    }
    return {bits_of(all_above | all_below), bits_of(any_above & any_below)};
}

GNOMON_WIDEST_VECTORS
LaneBits certainly_on_side(const LanePoints& points, const TrianglePlanes& planes, Sign side)
{
    constexpr std::size_t i = TrianglePlanes::surface;
    const LaneFloats value =
        planes.x[i] * points.x + planes.y[i] * points.y + planes.z[i] * points.z - planes.offset[i];
    return bits_of(static_cast<float>(side) * value > planes.size[i] * points.reach);
}

} // namespace gnomon::reference_rt
