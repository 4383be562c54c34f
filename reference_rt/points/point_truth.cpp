#include "reference_rt/points/point_truth.hpp"

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/rounded/nearest_surface.hpp"
#include "reference_rt/rounded/rounded_truth.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <tbb/combinable.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::InputError;
using scene::Light;
using scene::LightType;
using scene::no_triangle;
using scene::PixelClass;
using scene::PointSide;
using scene::PointTruth;
using scene::ProjectedPoints;
using scene::SurfacePoints;
using scene::Vec2d;
using scene::Vec3d;

namespace {

/// Below this, products of the light's numbers with coordinates could underflow (`is_well_scaled`).
constexpr double smallest_of_light = 1e-28;

void require_exact(const ReferenceScene& reference)
{
    if (!reference.implementation().padded) {
        throw std::invalid_argument{"truth of points: the reference must serve exact truth"};
    }
}

void require_sound(const Vec3d& vector, std::string_view what)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double size = std::abs(vector[axis]);
        if (size != 0 && !(size >= smallest_of_light && size <= scene::max_coordinate_m)) {
            throw InputError(fmt::format(
                "light.{}: {} is {}: numbers of a light must be 0, or from 1e-28 to 1e15 in size",
                what, "xyz"[axis], vector[axis]));
        }
    }
}

void require_sound(const Light& light)
{
    require_sound(light.direction, "direction");
    require_sound(light.position, "position");
    if (!light.has_position() && light.direction == Vec3d{0.0}) {
        throw InputError("light.direction is 0: it has no direction to shine in");
    }
}

void require_sound(const SurfacePoints& points, const scene::TriangleScene& triangles)
{
    if (points.triangles.size() != points.barycentrics.size()) {
        throw std::invalid_argument{"truth of points: not as many barycentrics as triangles"};
    }
    for (std::size_t i = 0; i < points.triangles.size(); ++i) {
        if (points.triangles[i] >= triangles.triangles.size()) {
            throw InputError(fmt::format("triangles[{}] is {}: the scene has {} triangles", i,
                                         points.triangles[i], triangles.triangles.size()));
        }
        const Vec2d& place = points.barycentrics[i];
        if (!(place.x >= -barycentric_slack && place.y >= -barycentric_slack &&
              place.x + place.y <= 1 + barycentric_slack)) {
            throw InputError(fmt::format("barycentrics[{}] is ({}, {}): u and v must be 0 or more, "
                                         "and u + v 1 or less",
                                         i, place.x, place.y));
        }
    }
}

void require_sound(std::span<const Vec3d> points)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(points[i][axis]) <= scene::max_coordinate_m)) {
                throw InputError(fmt::format("points[{}]: {} is {}: coordinates must be finite and "
                                             "within ±1e15",
                                             i, "xyz"[axis], points[i][axis]));
            }
        }
    }
}

/// Up to sixteen points as receivers. Must not move, as receivers refer to its members.
struct PointPacket {
    PointPacket() = default;
    PointPacket(const PointPacket&) = delete;
    PointPacket& operator=(const PointPacket&) = delete;

    void set(std::size_t lane, const SceneTriangle& triangle, const Vec2d& place)
    {
        faces[lane] = ExactTriangle{triangle};
        places[lane] = {place.x, place.y, triangle.corners};
        receivers[lane] = Receiver{faces[lane], places[lane]};
    }

    PacketOf<ExactTriangle> faces;
    PacketOf<BarycentricPlace> places;
    PacketOf<Receiver> receivers;
};

void set_lane(PointPacket& packet, std::size_t lane, const scene::TriangleScene& triangles,
              const SurfacePoints& points, std::size_t index)
{
    packet.set(lane, triangle_of(triangles, points.triangles[index]), points.barycentrics[index]);
}

void set_lane(PointPacket& packet, std::size_t lane, const scene::TriangleScene& /*triangles*/,
              std::span<const Vec3d> points, std::size_t index)
{
    const Vec3d point = points[index] + 0.0; // avoids −0
    packet.set(lane, {no_triangle, {point, point, point}}, {0, 0});
}

/// The class decided by the light's side and cone; `lit` if the segment must decide.
PixelClass class_without_segment(const Receiver& receiver, PointSide side, const Light& light,
                                 SignCounts& counts)
{
    if (receiver.triangle() != no_triangle) {
        const Sign of_light = light_side(*receiver.face, light, counts);
        const bool is_other_side =
            (side == PointSide::front && of_light < 0) || (side == PointSide::back && of_light > 0);
        if (of_light == 0 || is_other_side) {
            return PixelClass::attached;
        }
    }
    return is_out_of_light(receiver, light, counts) ? PixelClass::out_of_light : PixelClass::lit;
}

/// Whether the point is at the light, so that the open segment is empty.
bool is_at_light(const Receiver& receiver, const Light& light)
{
    return light.has_position() && receiver.triangle() == no_triangle &&
           receiver.corners()[0] == light.position;
}

/// Calls `run(begin, count)` for consecutive batches of whole packets.
template <typename Run>
void for_each_batch(std::size_t total, const PointOptions& options, const Run& run)
{
    constexpr std::size_t batch = std::size_t{1} << 16U;
    static_assert(batch % packet_size == 0);
    for (std::size_t begin = 0; begin < total; begin += batch) {
        if (options.check_interruption) {
            options.check_interruption();
        }
        run(begin, std::min(batch, total - begin));
    }
}

template <typename Points>
class PointRun {
public:
    PointRun(const ReferenceScene::Implementation& reference, const Light& light,
             const Points& points, PointSide side, std::size_t count)
        : reference_{reference},
          light_{light},
          points_{points},
          side_{side},
          segment_light_{reference, light},
          starts_{reference.frame, light},
          truth_{std::vector<PixelClass>(count, PixelClass::lit),
                 std::vector<ClassReason>(count),
                 std::vector<std::uint32_t>(count, no_triangle),
                 {}}
    {
    }

    void decide_packet(std::size_t first, std::size_t count)
    {
        SignCounts& counts = counts_.local();
        PointPacket packet;
        SegmentStarts starts;
        starts.receiver = [&](std::size_t lane) -> const Receiver& {
            return packet.receivers[lane];
        };
        for (std::size_t lane = 0; lane < count; ++lane) {
            set_lane(packet, lane, reference_.triangles, points_, first + lane);
            const Receiver& receiver = packet.receivers[lane];
            const PixelClass known = class_without_segment(receiver, side_, light_, counts);
            truth_.point_class[first + lane] = known;
            if (known == PixelClass::lit && !is_at_light(receiver, light_)) {
                starts_.add(lane, receiver, starts);
            }
        }
        const LaneBits asked = starts.lanes;
        if (asked == 0) {
            return;
        }
        const auto contacts =
            trace_segments(reference_, segment_light_, starts, SegmentGoal::any_blocker, counts);
        for (LaneBits rest = asked; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            const Shadowing shadowing = classify_segment(contacts[lane]);
            truth_.point_class[first + lane] = shadowing.pixel_class;
            truth_.reason[first + lane] = shadowing.reason;
            truth_.witness[first + lane] = contacts[lane].witness;
        }
    }

    [[nodiscard]] PointTruth take()
    {
        counts_.combine_each([&](const SignCounts& counts) {
            truth_.signs.filtered += counts.filtered;
            truth_.signs.exact += counts.exact;
        });
        return std::move(truth_);
    }

private:
    const ReferenceScene::Implementation& reference_;
    const Light& light_;
    const Points& points_;
    PointSide side_;
    SegmentLight segment_light_;
    PointStarts starts_;
    PointTruth truth_;
    tbb::combinable<SignCounts> counts_;
};

template <typename Points>
PointTruth decide(const ReferenceScene& reference, const Light& light, const Points& points,
                  PointSide side, std::size_t count, const PointOptions& options)
{
    const auto& implementation = reference.implementation();
    PointRun<Points> run{implementation, light, points, side, count};
    for_each_batch(count, options, [&](std::size_t begin, std::size_t in_batch) {
        for_each_packet(in_batch, options.threads, [&](std::size_t first, std::size_t in_packet) {
            run.decide_packet(begin + first, in_packet);
        });
    });
    implementation.errors.check("truth of points");
    return run.take();
}

} // namespace

PointTruth find_point_truth(const ReferenceScene& reference, const Light& light,
                            const SurfacePoints& points, const PointOptions& options)
{
    require_exact(reference);
    require_sound(light);
    require_sound(points, reference.triangles());
    return decide(reference, light, points, points.side, points.triangles.size(), options);
}

PointTruth find_point_truth(const ReferenceScene& reference, const Light& light,
                            std::span<const Vec3d> points, const PointOptions& options)
{
    require_exact(reference);
    require_sound(light);
    require_sound(points);
    return decide(reference, light, points, PointSide::to_light, points.size(), options);
}

ProjectedPoints project_points(const ReferenceScene& reference, std::span<const Vec3d> points,
                               const PointOptions& options)
{
    require_exact(reference);
    require_sound(points);
    ProjectedPoints projected;
    for_each_batch(points.size(), options, [&](std::size_t begin, std::size_t count) {
        const auto nearest =
            nearest_surfaces(reference, points.subspan(begin, count), {}, options.threads);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t triangle = nearest[i].triangle;
            if (triangle == no_triangle) {
                throw InputError(fmt::format("points[{}]: the scene has no triangle that receives "
                                             "shadow, onto which it could be moved",
                                             begin + i));
            }
            projected.triangles.push_back(triangle);
            projected.barycentrics.push_back(
                nearest_place(points[begin + i], corners_of(reference.triangles(), triangle)));
            projected.distance_m.push_back(nearest[i].distance_m);
        }
    });
    return projected;
}

} // namespace gnomon::reference_rt
