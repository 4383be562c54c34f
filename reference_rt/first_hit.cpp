#include "reference_rt/first_hit.hpp"

#include "reference_rt/stand_in.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::no_triangle;
using scene::PixelClass;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// True when the ray meets the closed facet beyond the near plane; `hit` is made where it meets it.
bool is_hit(const CameraRay& ray, const Facet& facet, double near_m, SignCounts& counts,
            Receiver& hit)
{
    if (!meets(ray, facet.corners, counts)) {
        return false;
    }
    hit = Receiver{facet, ray, counts};
    return is_beyond(hit, near_m, counts);
}

/// The camera rays of one packet: which are hidden from their receivers, or see where GL does not.
class Sight final : public CandidateJudge {
public:
    struct Setting {
        const ReferenceScene::Implementation& reference;
        const Pencil& pencil;
        bool has_eye;
        double near_m;
    };

    Sight(const Setting& setting, const Tile& tile, SignCounts& counts)
        : setting_{setting},
          tile_{tile},
          counts_{counts}
    {
    }

    /// The lanes in which GL is right.
    PacketMask match()
    {
        RTCRay16 packet;
        PacketMask traced;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (tile_.valid[i] && may_match(i)) {
                traced.add(i);
                prepare(i, packet);
            }
        }
        if (traced.any()) {
            setting_.reference.find_candidates(traced, packet, *this);
        }
        PacketMask matched;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (traced[i] && (hidden_ >> i & 1U) == 0 && receiver_is_hit(i)) {
                matched.add(i);
            }
        }
        return matched;
    }

    LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) override
    {
        const Corners corners = corners_of(setting_.reference.triangles, triangle);
        const LineVerdicts lines = judge_lines(
            points_, make_planes(setting_.reference.frame, setting_.pencil, corners,
                                 setting_.has_eye ? LaneKind::directions : LaneKind::points));
        const LaneBits open = asking & ~lines.outside;
        if (open == 0) {
            return 0;
        }
        const LaneBits own = lanes_on(triangle);
        covered_ |= own & lines.inside;
        LaneBits rest = open & ~own;
        if (rest == 0) {
            return 0;
        }
        const Facet facet{triangle, corners};
        LaneBits hidden = 0;
        for (; rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
            hidden |= hides(lane, facet) ? LaneBits{1} << lane : 0;
        }
        hidden_ |= hidden;
        return hidden;
    }

    void judge_distances(std::uint32_t /*triangle*/, LaneBits /*asking*/,
                         PacketOf<float>& /*t_far*/) override
    {
    }

private:
    /// False where GL's triangle is edge-on, or not beyond the near plane: it is no hit.
    [[nodiscard]] bool may_match(std::size_t i)
    {
        const Receiver& receiver = tile_.receivers[i];
        return !tile_.seen[i] || receiver.t - receiver.t_error > setting_.near_m ||
               (receiver.delta_sign != 0 && is_beyond(receiver, setting_.near_m, counts_));
    }

    void prepare(std::size_t i, RTCRay16& packet)
    {
        const CameraStandIn stand_in{tile_.rays[i], setting_.reference.frame};
        if (setting_.has_eye) {
            points_.set(i, tile_.rays[i].ray.direction, 0);
        } else {
            points_.set(i, stand_in.origin().position, stand_in.origin().error);
        }
        own_[i] = tile_.seen[i] ? tile_.receivers[i].triangle() : no_triangle;
        set_lane(packet, i,
                 stand_in.ray(tile_.seen[i] ? stand_in.t_beyond(tile_.receivers[i]) : infinity));
    }

    /// The valid lanes in which GL saw the triangle.
    [[nodiscard]] LaneBits lanes_on(std::uint32_t triangle) const
    {
        LaneBits lanes = 0;
        for (std::size_t i = 0; i < packet_size; ++i) {
            lanes |= own_[i] == triangle ? LaneBits{1} << i : 0;
        }
        return lanes;
    }

    /// True when the lane's ray meets the facet before its receiver, or without having one.
    [[nodiscard]] bool hides(std::size_t lane, const Facet& facet)
    {
        Receiver hit;
        return is_hit(tile_.rays[lane], facet, setting_.near_m, counts_, hit) &&
               (!tile_.seen[lane] || compare_distance(hit, tile_.receivers[lane], counts_) < 0);
    }

    /// True when nothing was expected, or the ray meets the closed T.
    [[nodiscard]] bool receiver_is_hit(std::size_t i)
    {
        return !tile_.seen[i] || (covered_ >> i & 1U) != 0 ||
               meets(tile_.rays[i], tile_.receivers[i].corners(), counts_);
    }

    Setting setting_;
    const Tile& tile_;
    SignCounts& counts_;
    LanePoints points_;
    PacketOf<std::uint32_t> own_{};
    LaneBits covered_ = 0; ///< T certainly covers the pixel's centre
    LaneBits hidden_ = 0;
};

/// The first hits of one ray, ties included.
class NearestHits final : public CandidateJudge {
public:
    NearestHits(const ReferenceScene::Implementation& reference, const CameraRay& ray,
                double near_m, SignCounts& counts)
        : reference_{reference},
          ray_{ray},
          near_m_{near_m},
          counts_{counts},
          stand_in_{ray, reference.frame}
    {
    }

    std::vector<std::uint32_t> find()
    {
        RTCRayHit single{};
        set_ray(single.ray, stand_in_.ray(infinity));
        single.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        reference_.find_candidates(single, *this);
        return std::move(triangles_);
    }

    LaneBits judge_packet(std::uint32_t /*triangle*/, LaneBits /*asking*/) override { return 0; }

    void judge_distances(std::uint32_t triangle, LaneBits /*asking*/,
                         PacketOf<float>& t_far) override
    {
        const Facet facet{triangle, corners_of(reference_.triangles, triangle)};
        Receiver hit;
        if (!is_hit(ray_, facet, near_m_, counts_, hit)) {
            return;
        }
        const Sign order = triangles_.empty() ? -1 : compare_distance(hit, nearest_, counts_);
        if (order < 0) {
            triangles_.clear();
            nearest_facet_ = facet;
            nearest_ = Receiver{nearest_facet_, ray_, counts_};
        }
        if (order <= 0) {
            triangles_.push_back(triangle);
        }
        t_far[0] = std::min(t_far[0], stand_in_.t_beyond(nearest_));
    }

private:
    const ReferenceScene::Implementation& reference_;
    const CameraRay& ray_;
    double near_m_;
    SignCounts& counts_;
    CameraStandIn stand_in_;
    std::vector<std::uint32_t> triangles_; ///< all at the same distance
    Facet nearest_facet_;
    Receiver nearest_;
};

} // namespace

FirstHits::FirstHits(const ReferenceScene::Implementation& reference, const scene::View& view,
                     const RasterFacts& facts)
    : reference_{reference},
      near_m_{receiver_near_m(reference.bounds)},
      pencil_{reference.frame, view.camera},
      has_eye_{view.camera.projection == scene::Projection::perspective},
      raster_{reference.triangles, view, reference.bounds, facts}
{
}

PacketMask FirstHits::match(const Tile& tile, SignCounts& counts) const
{
    return Sight{{reference_, pencil_, has_eye_, near_m_}, tile, counts}.match();
}

std::vector<std::uint32_t> FirstHits::first_hits(const CameraRay& ray, SignCounts& counts) const
{
    return NearestHits{reference_, ray, near_m_, counts}.find();
}

UnmatchedVerdict FirstHits::explain(const CameraRay& ray, int x, int y, std::uint32_t triangle,
                                    SignCounts& counts) const
{
    const auto first = first_hits(ray, counts);
    const auto unmatched = [](ClassReason reason) {
        return UnmatchedVerdict{PixelClass::unmatched, reason};
    };
    if (triangle == no_triangle && first.empty()) {
        return {PixelClass::background, ClassReason::none};
    }
    const bool is_first_snapped = std::ranges::any_of(
        first, [&](std::uint32_t hit) { return raster_.coverage_may_differ(hit, x, y, true); });
    if (is_first_snapped) {
        return unmatched(ClassReason::snap);
    }
    if (triangle == no_triangle) {
        return unmatched(ClassReason::mismatch);
    }
    const Facet facet{triangle, corners_of(reference_.triangles, triangle)};
    Receiver hit;
    const bool is_seen = is_hit(ray, facet, near_m_, counts, hit);
    if (raster_.coverage_may_differ(triangle, x, y, is_seen)) {
        return unmatched(ClassReason::snap);
    }
    return unmatched(is_seen && !first.empty() && raster_.is_tie(first.front(), triangle, x, y)
                         ? ClassReason::tie
                         : ClassReason::mismatch);
}

} // namespace gnomon::reference_rt
