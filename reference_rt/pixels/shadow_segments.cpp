#include "reference_rt/pixels/shadow_segments.hpp"

#include "reference_rt/exact/crossing_depth.hpp"
#include "reference_rt/exact/triangle_contact.hpp"

#include <algorithm>

namespace gnomon::reference_rt {

using scene::no_triangle;
using scene::Vec3d;

namespace {

struct EdgeContact {
    std::size_t lane = 0;
    std::uint32_t triangle = no_triangle;
    int edge = 0;
};

/// The segments of one packet while Embree traverses the boxes.
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
        // The segment meets the plane of T at P only.
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

    /// Shows every caster to the lanes that Embree cannot trace.
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

    /// Finds exactly the points that doubles do not resolve.
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

    /// @param towards  side of the light from the triangle where it is certain, else 0.
    [[nodiscard]] bool is_culled(Sign towards, const Corners& s)
    {
        return scope_.cull != scene::Cull::none &&
               !is_left(scope_.cull, towards != 0 ? towards : light_side(s, light_.light, counts_));
    }
    [[nodiscard]] bool is_in_range(std::size_t lane, const Corners& s)
    {
        return scope_.depth == nullptr ||
               crosses_in_range(receiver(lane), s, light_.light, *scope_.depth, counts_);
    }

    /// The lane's bit when the triangle settles it; contacts that do not are kept.
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

    /// True when the two triangles' surface passes through the segment at the edge of `contact`.
    [[nodiscard]] bool forms_seam(const EdgeContact& contact, const EdgeContact& other)
    {
        return reference_rt::forms_seam(edge_of(corners(contact.triangle), contact.edge),
                                        edge_of(corners(other.triangle), other.edge), light_.light,
                                        counts_);
    }

    /// Pairs up the edge contacts: a seam blocks, with its lower triangle as the witness.
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
            witness = triangle; // any proper crossing is the plainer proof
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

} // namespace gnomon::reference_rt
