#include "reference_rt/rounded/rounded_segments.hpp"

#include "reference_rt/exact/triangle_contact.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace gnomon::reference_rt {

using scene::no_triangle;
using scene::PixelClass;

namespace {

/// Whether no corner of S is on the light's side of the plane of T, which segments leave on the
/// light's side.
bool is_behind(const ExactTriangle& face, Sign light_side, const Corners& s, SignCounts& counts)
{
    return std::all_of(s.begin(), s.end(), [&](const scene::Vec3d& corner) {
        return light_side * sign_of(counts, true,
                                    [&]<typename Field>(Field) {
                                        return dot(normal_of<Field>(face.corners),
                                                   difference<Field>(corner, face.corners[0]));
                                    }) <=
               0;
    });
}

/// The segments of up to sixteen starts during Embree's traversal.
class RoundedSegments final : public CandidateTest {
public:
    RoundedSegments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
                    std::span<const RoundedStart> starts, SignCounts& counts)
        : reference_{reference},
          light_{light},
          starts_{starts},
          counts_{counts}
    {
    }

    [[nodiscard]] PacketOf<HypothesisVerdict> trace()
    {
        LanePositions positions{};
        LaneBits lanes = 0;
        for (std::size_t i = 0; i < starts_.size(); ++i) {
            const RoundedStart& start = starts_[i];
            triangles_[i] = start.face.triangle;
            lanes |= LaneBits{1} << i;
            const scene::Vec3d point = reference_.frame.from_world(start.point);
            // Covers the difference and the product.
            const double rounding = 4 * unit_roundoff * (1 + largest(point));
            positions.set(i, {point, reference_.frame.scale() * start.box.reach_m(start.point) *
                                             (1 + 0x1p-40) +
                                         rounding});
        }
        points_.set(positions);
        FloatRays rays{};
        light_.proxy.from(positions, lanes, rays);
        reference_.find_candidates(lanes, rays, casters, *this);
        PacketOf<HypothesisVerdict> verdicts;
        for (std::size_t i = 0; i < starts_.size(); ++i) {
            verdicts[i] = verdict(i);
        }
        return verdicts;
    }

    LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) override
    {
        asking &= ~lanes_with(triangles_, triangle); // T is met only at P
        if (asking == 0) {
            return 0;
        }
        const SceneTriangle s = triangle_of(reference_.triangles, triangle);
        const TrianglePlanes planes =
            make_planes(reference_.frame, light_.ray_bundle, s, LaneKind::points);
        const LineVerdicts lines = judge_lines(points_, planes);
        LaneBits open = asking & ~lines.outside;
        LaneBits settled = 0;
        if (open != 0 && planes.towards != 0) {
            settled = open & lines.inside & certainly_on_side(points_, planes, -planes.towards);
            open &= ~(settled | certainly_on_side(points_, planes, planes.towards));
        }
        for (LaneBits rest = settled; rest != 0; rest &= rest - 1) {
            witnesses_[first_lane(rest)] = triangle;
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

private:
    struct Open {
        std::uint32_t triangle = no_triangle;
        Passage passage;
    };

    /// Returns the lane's bit if the triangle settles it; otherwise records a triangle that may be
    /// touched.
    LaneBits decide(std::size_t lane, const SceneTriangle& s)
    {
        const ExactTriangle& face = starts_[lane].face;
        if (is_behind(face, light_side(face, light_.light, counts_), s.corners, counts_)) {
            return 0;
        }
        const PlaneSection& section = section_of(lane);
        const Passage passage = section.empty()
                                    ? Passage{.may_touch = true}
                                    : find_passage(section.corners(), s, light_.light, counts_);
        if (passage.crosses_all()) {
            witnesses_[lane] = s.triangle;
            return LaneBits{1} << lane;
        }
        if (passage.may_touch) {
            open_[lane].push_back({s.triangle, passage});
        }
        return 0;
    }

    [[nodiscard]] const PlaneSection& section_of(std::size_t lane)
    {
        std::optional<PlaneSection>& section = sections_[lane];
        return section ? *section : section.emplace(starts_[lane].box, starts_[lane].face, counts_);
    }

    [[nodiscard]] HypothesisVerdict verdict(std::size_t lane)
    {
        if (witnesses_[lane] != no_triangle) {
            return {PixelClass::blocked, witnesses_[lane]};
        }
        if (open_[lane].empty()) {
            return {PixelClass::lit, no_triangle};
        }
        for (std::size_t i = 0; i < open_[lane].size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (crosses_all_together(open_[lane][i], open_[lane][j])) {
                    return {PixelClass::blocked,
                            std::min(open_[lane][i].triangle, open_[lane][j].triangle)};
                }
            }
        }
        return {PixelClass::indeterminate, no_triangle};
    }

    /// Whether each segment crosses one of two triangles, or the seam between them.
    ///
    /// The triangles lie on opposite sides of the plane through the light and their common edge. A
    /// segment on one triangle's side, inside its other two edges, is inside all three.
    [[nodiscard]] bool crosses_all_together(const Open& a, const Open& b)
    {
        const Corners corners_a = corners_of(reference_.triangles, a.triangle);
        const Corners corners_b = corners_of(reference_.triangles, b.triangle);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (a.passage.crosses_all_beside(i) && b.passage.crosses_all_beside(j) &&
                    forms_seam(edge_of(corners_a, static_cast<int>(i)),
                               edge_of(corners_b, static_cast<int>(j)), light_.light, counts_)) {
                    return true;
                }
            }
        }
        return false;
    }

    const ReferenceScene::Implementation& reference_;
    const SegmentLight& light_;
    std::span<const RoundedStart> starts_;
    SignCounts& counts_;
    LanePoints points_;
    Lanes<std::uint32_t> triangles_{};
    PacketOf<std::uint32_t> witnesses_ = filled_with_no_triangle();
    PacketOf<std::vector<Open>> open_;
    PacketOf<std::optional<PlaneSection>> sections_;

    static PacketOf<std::uint32_t> filled_with_no_triangle()
    {
        PacketOf<std::uint32_t> none{};
        none.fill(no_triangle);
        return none;
    }
};

} // namespace

double start_reach(const ReferenceScene::Implementation& reference)
{
    // `box_padding` uses 75 of its 96 units, one of them for the start.
    constexpr double spare = 20 * float_roundoff;
    return spare + reference.padding - box_padding;
}

PacketOf<HypothesisVerdict> trace_rounded_segments(const ReferenceScene::Implementation& reference,
                                                   const SegmentLight& light,
                                                   std::span<const RoundedStart> starts,
                                                   SignCounts& counts)
{
    RoundedSegments segments{reference, light, starts, counts};
    return segments.trace();
}

} // namespace gnomon::reference_rt
