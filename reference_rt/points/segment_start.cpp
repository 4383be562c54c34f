#include "reference_rt/points/segment_start.hpp"

#include "reference_rt/exact/terms.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

/// Twice the scene's box, which reaches to 1: room for what the entry is off, at most
/// 2^-52 · `farthest_clipped`.
constexpr double near_box = 2;
/// Farther away doubles do not say whether a segment comes near the scene.
constexpr double farthest_clipped = 0x1p48;

/// P in the unit frame, computed in double.
IntervalPoint rounded_point(const Receiver& receiver, const UnitFrame& frame)
{
    const auto& [a, b, c] = receiver.corners();
    const Vec3d corner = frame.from_world(a);
    const Vec3d along_u = frame.scale() * receiver.place->u * (b - a);
    const Vec3d along_v = frame.scale() * receiver.place->v * (c - a);
    // A term has at most four roundings, and the sums two.
    const double size = largest(corner) + largest(along_u) + largest(along_v);
    return {corner + along_u + along_v, 8 * unit_roundoff * size};
}

/// The share of the way from `point` to the light at which it enters the box around the scene;
/// empty where it misses it.
std::optional<double> entry(const Vec3d& point, const Vec3d& step, double end)
{
    double enter = 0;
    double leave = end;
    for (int axis = 0; axis < 3; ++axis) {
        if (step[axis] == 0) {
            if (std::abs(point[axis]) > near_box) {
                return std::nullopt;
            }
            continue;
        }
        const double first = (-near_box - point[axis]) / step[axis];
        const double second = (near_box - point[axis]) / step[axis];
        enter = std::max(enter, std::min(first, second));
        leave = std::min(leave, std::max(first, second));
    }
    return enter <= leave ? std::optional{enter} : std::nullopt;
}

void take_in(std::size_t lane, const IntervalPoint& point, SegmentStarts& starts)
{
    starts.lanes |= LaneBits{1} << lane;
    starts.points.set(lane, point);
}

} // namespace

PointStarts::PointStarts(const UnitFrame& frame, const scene::Light& light)
    : frame_{frame},
      light_{light},
      unit_light_{light.has_position() ? frame.from_world(light.position)
                                       : normalised(-light.direction)}
{
}

void PointStarts::add(std::size_t lane, const Receiver& receiver, SegmentStarts& starts) const
{
    starts.triangles[lane] = receiver.triangle();
    const IntervalPoint point = rounded_point(receiver, frame_);
    if (largest(point.position) <= farthest_origin) {
        take_in(lane, point, starts);
    } else {
        add_far(lane, receiver, point, starts);
    }
}

void PointStarts::add_far(std::size_t lane, const Receiver& receiver, const IntervalPoint& point,
                          SegmentStarts& starts) const
{
    if (largest(point.position) > farthest_clipped) {
        take_in(lane, point, starts);
        starts.beyond_embree |= LaneBits{1} << lane;
        return;
    }
    const bool has_end = light_.has_position();
    const Vec3d step = has_end ? unit_light_ - point.position : unit_light_;
    const auto share =
        entry(point.position, step, has_end ? 1.0 : std::numeric_limits<double>::infinity());
    if (!share) {
        return;
    }
    const Vec3d way = *share * step;
    IntervalPoint start{point.position + way,
                        point.error + 8 * unit_roundoff * (largest(point.position) + largest(way))};
    if (!is_resolved(start.error)) {
        start = exact_start(receiver, *share);
    }
    take_in(lane, start, starts);
}

/// P + share·(L − P), or P − (share·2^e)ℓ where 2^e makes ℓ as long as in the unit frame.
IntervalPoint PointStarts::exact_start(const Receiver& receiver, double share) const
{
    const auto from_centre = scaled_offset(ExactField{}, receiver, frame_.centre());
    const auto way = light_.has_position()
                         ? difference<ExactField>(light_.position, frame_.centre())
                         : vector<ExactField>(unit_light_);
    const Dyadic one{1.0};
    const Dyadic along{light_.has_position() ? share : share / frame_.scale()};
    const Dyadic stays = light_.has_position() ? one - along : one;
    const auto start = stays * from_centre + along * way;
    const Vec3d position =
        frame_.scale() * Vec3d{Dyadic::quotient(start.x, one), Dyadic::quotient(start.y, one),
                               Dyadic::quotient(start.z, one)};
    return {position, 0x1p-49 * largest(position)};
}

} // namespace gnomon::reference_rt
