#include "reference_rt/first_hit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::no_triangle;
using scene::PixelClass;
using scene::Vec3d;

namespace {

/// The hit of a ray with a closed triangle beyond the near plane, if there is one.
std::optional<Receiver> closed_hit(const CameraRay& ray, std::uint32_t triangle,
                                   const Corners& corners, double near_m, SignCounts& counts)
{
    if (!meets(ray, corners, counts)) {
        return std::nullopt;
    }
    const Receiver hit{Facet{triangle, corners}, ray, counts};
    return is_beyond(hit, near_m, counts) ? std::optional{hit} : std::nullopt;
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

    Sight(const Setting& setting, const PacketOf<CameraRay>& rays,
          const PacketOf<Receiver>& receivers, SignCounts& counts)
        : setting_{setting},
          rays_{rays},
          receivers_{receivers},
          counts_{counts}
    {
    }

    /// The lanes in which GL is right.
    PacketMask match(const PacketMask& valid)
    {
        RTCRay16 packet;
        PacketMask traced;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (valid[i] && has_usable_receiver(i)) {
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
        const LineVerdicts lines =
            judge_lines(points_, edge_planes(setting_.reference.frame, setting_.pencil, corners,
                                             setting_.has_eye));
        const LaneBits open = asking & ~lines.outside;
        if (open == 0) {
            return 0;
        }
        const LaneBits own = lanes_on(triangle);
        covered_ |= own & lines.inside;
        LaneBits hidden = 0;
        for (LaneBits rest = open & ~own; rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
            hidden |= hides(lane, triangle, corners) ? rest & (~rest + 1) : 0;
        }
        hidden_ |= hidden;
        return hidden;
    }

    float judge_ray(std::uint32_t /*triangle*/, float t_far) override { return t_far; }

private:
    /// False where GL's triangle is edge-on, or not beyond the near plane: it is no hit.
    [[nodiscard]] bool has_usable_receiver(std::size_t i)
    {
        const Receiver& receiver = receivers_[i];
        return receiver.triangle == no_triangle ||
               (receiver.delta_sign != 0 && is_beyond(receiver, setting_.near_m, counts_));
    }

    void prepare(std::size_t i, RTCRay16& packet)
    {
        const UnitFrame& frame = setting_.reference.frame;
        const CameraStandIn stand_in{rays_[i], frame};
        if (setting_.has_eye) {
            points_.set(i, stand_in.direction(), 0);
        } else {
            points_.set(i, stand_in.origin().position, stand_in.origin().error);
        }
        own_[i] = receivers_[i].triangle;
        set_lane(packet, i,
                 own_[i] == no_triangle
                     ? stand_in.ray()
                     : stand_in.ray(stand_in.t_beyond(unit_point(receivers_[i], frame).position)));
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

    /// True when the lane's ray meets the triangle before its receiver, or without having one.
    [[nodiscard]] bool hides(std::size_t lane, std::uint32_t triangle, const Corners& corners)
    {
        const auto hit = closed_hit(rays_[lane], triangle, corners, setting_.near_m, counts_);
        return hit &&
               (own_[lane] == no_triangle || compare_distance(*hit, receivers_[lane], counts_) < 0);
    }

    /// True when nothing was expected, or the ray meets the closed T.
    [[nodiscard]] bool receiver_is_hit(std::size_t i)
    {
        return own_[i] == no_triangle || (covered_ >> i & 1U) != 0 ||
               meets(rays_[i], receivers_[i].corners, counts_);
    }

    Setting setting_;
    const PacketOf<CameraRay>& rays_;
    const PacketOf<Receiver>& receivers_;
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

    std::vector<Receiver> find()
    {
        RTCRayHit single{};
        set_ray(single.ray, stand_in_.ray());
        single.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        reference_.find_candidates(single, *this);
        return std::move(nearest_);
    }

    LaneBits judge_packet(std::uint32_t /*triangle*/, LaneBits /*asking*/) override { return 0; }

    float judge_ray(std::uint32_t triangle, float t_far) override
    {
        const auto hit = closed_hit(ray_, triangle, corners_of(reference_.triangles, triangle),
                                    near_m_, counts_);
        if (!hit) {
            return t_far;
        }
        const Sign order =
            nearest_.empty() ? -1 : compare_distance(*hit, nearest_.front(), counts_);
        if (order < 0) {
            nearest_.clear();
        }
        if (order <= 0) {
            nearest_.push_back(*hit);
        }
        const auto& nearest = nearest_.front();
        return std::min(t_far, stand_in_.t_beyond(unit_point(nearest, reference_.frame).position));
    }

private:
    const ReferenceScene::Implementation& reference_;
    const CameraRay& ray_;
    double near_m_;
    SignCounts& counts_;
    CameraStandIn stand_in_;
    std::vector<Receiver> nearest_;
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

PacketMask FirstHits::match(const PacketMask& valid, const PacketOf<CameraRay>& rays,
                            const PacketOf<Receiver>& receivers, SignCounts& counts) const
{
    return Sight{{reference_, pencil_, has_eye_, near_m_}, rays, receivers, counts}.match(valid);
}

std::vector<Receiver> FirstHits::first_hits(const CameraRay& ray, SignCounts& counts) const
{
    return NearestHits{reference_, ray, near_m_, counts}.find();
}

bool FirstHits::is_tie(const Receiver& seen, const Receiver& first, int x, int y) const
{
    const double gap = std::abs(raster_.depth(seen.point()) - raster_.depth(first.point()));
    return gap <=
           raster_.depth_error(seen.triangle, x, y) + raster_.depth_error(first.triangle, x, y);
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
    const bool is_first_snapped = std::ranges::any_of(first, [&](const Receiver& hit) {
        return raster_.coverage_may_differ(hit.triangle, x, y, true);
    });
    if (is_first_snapped) {
        return unmatched(ClassReason::snap);
    }
    if (triangle == no_triangle) {
        return unmatched(ClassReason::mismatch);
    }
    const Corners corners = corners_of(reference_.triangles, triangle);
    const auto seen = closed_hit(ray, triangle, corners, near_m_, counts);
    if (raster_.coverage_may_differ(triangle, x, y, seen.has_value())) {
        return unmatched(ClassReason::snap);
    }
    return unmatched(seen && !first.empty() && is_tie(*seen, first.front(), x, y)
                         ? ClassReason::tie
                         : ClassReason::mismatch);
}

} // namespace gnomon::reference_rt
