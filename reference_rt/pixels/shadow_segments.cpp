#include "reference_rt/pixels/shadow_segments.hpp"

#include "reference_rt/exact/crossing_depth.hpp"
#include "reference_rt/exact/terms.hpp"
#include "reference_rt/exact/triangle_contact.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::reference_rt {

using scene::no_triangle;
using scene::Vec3d;

namespace {

struct EdgeContact {
    std::size_t lane = 0;
    std::uint32_t triangle = no_triangle;
    int edge = 0;
};

/// The segments of a packet during Embree's traversal.
class Segments final : public CandidateTest {
public:
    Segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
             SegmentStarts& starts, SegmentGoal goal, const SegmentScope& scope, SignCounts& counts)
        : reference_{reference},
          light_{light},
          starts_{starts},
          goal_{goal},
          scope_{scope},
          counts_{counts}
    {
    }

    void trace()
    {
        resolve_points();
        points_.set(starts_.points);
        FloatRays rays{};
        const LaneBits traced = starts_.lanes & ~starts_.beyond_embree;
        light_.proxy.from(starts_.points, traced, rays);
        reference_.find_candidates(traced, rays, casters, *this);
        judge_all_casters();
        resolve_edges();
    }

    LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) override
    {
        // The segment meets the plane of T only at P.
        asking &= ~lanes_with(starts_.triangles, triangle);
        if (asking == 0) {
            return 0;
        }
        const SceneTriangle s = triangle_of(reference_.triangles, triangle);
        TrianglePlanes planes =
            make_planes(reference_.frame, light_.ray_bundle, s, LaneKind::points);
        const LineVerdicts lines = judge_lines(points_, planes);
        LaneBits open = asking & ~lines.outside;
        if (open == 0 || is_culled(planes.towards, s.corners)) {
            return 0;
        }
        LaneBits crossing = 0;
        planes.towards *= reference_.faults.light_sign;
        if (planes.towards != 0) {
            const LaneBits sure = open & lines.inside;
            crossing = sure & certainly_on_side(points_, planes, -planes.towards);
            open &= ~(crossing | (sure & certainly_on_side(points_, planes, planes.towards)));
        }
        LaneBits settled = 0;
        for (LaneBits rest = crossing; rest != 0; rest &= rest - 1) {
            const auto lane = first_lane(rest);
            settled |= is_in_range(lane, s.corners) ? block(lane, triangle) : 0;
        }
        for (LaneBits rest = open; rest != 0; rest &= rest - 1) {
            settled |= decide(first_lane(rest), s);
        }
        return settled;
    }

    void judge_distances(std::uint32_t /*triangle*/, LaneBits /*asking*/,
                         PacketOf<float>& /*t_far*/) override
    {
    }

    [[nodiscard]] const PacketOf<SegmentContacts>& contacts() const { return contacts_; }

private:
    [[nodiscard]] const Receiver& receiver(std::size_t lane) const
    {
        return starts_.receiver(lane);
    }

    /// Tests every caster against the lanes that Embree cannot trace.
    void judge_all_casters()
    {
        LaneBits open = starts_.beyond_embree;
        if (open == 0) {
            return;
        }
        for (const scene::TriangleRange& range : scene::casting_ranges(reference_.triangles)) {
            for (std::uint32_t i = 0; i < range.count && open != 0; ++i) {
                open &= ~judge_packet(range.first + i, open);
            }
        }
    }

    /// Computes exactly the points that doubles do not resolve.
    void resolve_points()
    {
        for (LaneBits rest = starts_.lanes & ~starts_.beyond_embree; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            if (!is_resolved(starts_.points.error[lane])) {
                starts_.points.set(lane, exact_unit_point(receiver(lane), reference_.frame));
            }
        }
    }

    [[nodiscard]] Corners corners(std::uint32_t triangle) const
    {
        return corners_of(reference_.triangles, triangle);
    }

    /// @param towards  side of the light of the triangle if certain, else 0.
    [[nodiscard]] bool is_culled(Sign towards, const Corners& s)
    {
        return scope_.cull != scene::Cull::none &&
               !is_kept_by_culling(scope_.cull,
                                   towards != 0 ? towards : light_side(s, light_.light, counts_));
    }
    [[nodiscard]] bool is_in_range(std::size_t lane, const Corners& s)
    {
        return scope_.depth == nullptr ||
               crosses_in_range(receiver(lane), s, light_.light, *scope_.depth, counts_);
    }

    /// Returns the lane's bit if the triangle settles it; otherwise records the contact.
    LaneBits decide(std::size_t lane, const SceneTriangle& s)
    {
        const TriangleContact contact = find_contact(receiver(lane), s, light_.light, counts_);
        switch (contact.kind) {
        case Contact::none:
            break;
        case Contact::cross:
            return is_in_range(lane, s.corners) ? block(lane, s.triangle) : 0;
        case Contact::edge:
            if (is_in_range(lane, s.corners)) {
                edges_.push_back({lane, s.triangle, contact.edge});
            }
            break;
        case Contact::vertex:
            contacts_[lane].touches_vertex = true;
            break;
        case Contact::plane:
            contacts_[lane].runs_in_triangle = true;
            break;
        }
        return 0;
    }

    LaneBits block(std::size_t lane, std::uint32_t triangle)
    {
        std::uint32_t& witness = contacts_[lane].witness;
        if (goal_ == SegmentGoal::any_blocker) {
            witness = triangle;
            return LaneBits{1} << lane;
        }
        witness = witness == no_triangle ? triangle : nearer(receiver(lane), witness, triangle);
        return 0;
    }

    [[nodiscard]] std::uint32_t nearer(const Receiver& receiver, std::uint32_t a, std::uint32_t b)
    {
        const Sign order =
            compare_nearness_to_light(receiver, corners(a), corners(b), light_.light, counts_);
        return order == 0 ? std::min(a, b) : (order > 0 ? a : b);
    }

    /// Whether the segment passes through the two triangles' surface at the edge of `contact`.
    [[nodiscard]] bool forms_seam(const EdgeContact& contact, const EdgeContact& other)
    {
        return reference_rt::forms_seam(edge_of(corners(contact.triangle), contact.edge),
                                        edge_of(corners(other.triangle), other.edge), light_.light,
                                        counts_);
    }

    /// Pairs edge contacts into seams. A seam blocks; its lower triangle is the witness.
    void resolve_edges()
    {
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const EdgeContact& contact = edges_[i];
            contacts_[contact.lane].touches_edge = true;
            for (std::size_t j = 0; j < i; ++j) {
                const EdgeContact& other = edges_[j];
                if (other.lane == contact.lane && forms_seam(contact, other)) {
                    block_by_seam(contact.lane, std::min(contact.triangle, other.triangle));
                }
            }
        }
    }

    void block_by_seam(std::size_t lane, std::uint32_t triangle)
    {
        std::uint32_t& witness = contacts_[lane].witness;
        if (goal_ == SegmentGoal::nearest_blocker) {
            block(lane, triangle);
        } else if (witness == no_triangle) {
            witness = triangle; // prefers a proper crossing as the simpler proof
        }
    }

    const ReferenceScene::Implementation& reference_;
    const SegmentLight& light_;
    SegmentStarts& starts_;
    SegmentGoal goal_;
    SegmentScope scope_;
    SignCounts& counts_;
    LanePoints points_;
    PacketOf<SegmentContacts> contacts_;
    std::vector<EdgeContact> edges_;
};

} // namespace

PacketOf<SegmentContacts> trace_segments(const ReferenceScene::Implementation& reference,
                                         const SegmentLight& light, SegmentStarts& starts,
                                         SegmentGoal goal, SignCounts& counts,
                                         const SegmentScope& scope)
{
    Segments segments{reference, light, starts, goal, scope, counts};
    segments.trace();
    return segments.contacts();
}

PacketOf<SegmentContacts> trace_segments(const ReferenceScene::Implementation& reference,
                                         const SegmentLight& light, const PacketMask& valid,
                                         const PacketOf<Receiver>& receivers, SegmentGoal goal,
                                         SignCounts& counts, const SegmentScope& scope)
{
    SegmentStarts starts;
    starts.receiver = [&](std::size_t lane) -> const Receiver& { return receivers[lane]; };
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i]) {
            starts.lanes |= LaneBits{1} << i;
            starts.points.set(i, unit_point(receivers[i], reference.frame));
            starts.triangles[i] = receivers[i].triangle();
        }
    }
    return trace_segments(reference, light, starts, goal, counts, scope);
}

using scene::Vec3d;

namespace {

/// Twice the scene's box, which reaches to 1, to cover the entry's error of at most 2^-52 ·
/// `farthest_clipped`.
constexpr double near_box = 2;
/// Beyond this, doubles do not decide whether a segment comes near the scene.
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

/// The fraction of the way from `point` to the light at which it enters the box around the scene;
/// empty if it misses.
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

/// P + share·(L − P), or P − (share·2^e)ℓ, where 2^e scales ℓ to its length in the unit frame.
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
