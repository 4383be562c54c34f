#include "reference_rt/pixels/first_hit.hpp"

#include "reference_rt/exact/triangle_contact.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"
#include "reference_rt/truth.hpp"
#include "scene/infinity.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::infinity;
using scene::no_triangle;
using scene::PixelClass;

namespace {

/// Whether the ray meets the closed triangle beyond the near plane; sets `hit` to the intersection.
bool is_hit(const CameraRay& ray, const ExactTriangle& face, double near_m, SignCounts& counts,
            Receiver& hit)
{
    if (hit_of(ray, face, counts).kind == Contact::none) {
        return false;
    }
    hit = Receiver{face, ray, counts};
    return is_beyond(hit, near_m, counts);
}

/// The lanes whose hit is certainly beyond the near plane.
GNOMON_WIDEST_VECTORS
LaneBits certainly_beyond(const LaneHits& hits, double near_m)
{
    Lanes<int> is_beyond;
    for (std::size_t i = 0; i < packet_size; ++i) {
        is_beyond[i] = static_cast<int>(hits.t[i] - hits.t_error[i] > near_m);
    }
    return bits_of(is_beyond);
}

/// Finds the camera rays of a packet whose receivers are hidden, or that see a triangle where GL
/// saw none.
class FirstHitTest final : public CandidateTest {
public:
    struct Setting {
        const ReferenceScene::Implementation& reference;
        const RayBundle& ray_bundle;
        bool has_eye;
        double near_m;
    };

    FirstHitTest(const Setting& setting, const Tile& tile, const LanePositions& points,
                 SignCounts& counts)
        : setting_{setting},
          tile_{tile},
          counts_{counts}
    {
        if (tile.seen != 0) {
            hits_.set(points);
        }
    }

    /// The lanes in which GL is right.
    LaneBits match()
    {
        const LaneBits traced = tile_.valid & ~nowhere_hit();
        if (traced == 0) {
            return 0;
        }
        FloatRays proxy_rays;
        LanePositions origins;
        proxy_rays_for(tile_.rays, tile_.hits, tile_.seen, setting_.reference.frame, proxy_rays,
                       origins);
        points_.set(setting_.has_eye ? directions() : origins);
        setting_.reference.find_candidates(traced, proxy_rays, receivers, *this);
        LaneBits matched = traced & ~hidden_;
        for (LaneBits rest = matched & tile_.seen & ~covered_; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            if (hit_of(tile_.rays.ray(lane), tile_.face(lane), counts_).kind == Contact::none) {
                matched &= ~(LaneBits{1} << lane);
            }
        }
        return matched;
    }

    LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) override
    {
        const SceneTriangle s = triangle_of(setting_.reference.triangles, triangle);
        const TrianglePlanes planes =
            make_planes(setting_.reference.frame, setting_.ray_bundle, s,
                        setting_.has_eye ? LaneKind::directions : LaneKind::points);
        const LineVerdicts lines = judge_lines(points_, planes);
        const LaneBits open = asking & ~lines.outside;
        if (open == 0) {
            return 0;
        }
        const LaneBits own = tile_.seen & lanes_with(tile_.triangles, triangle);
        covered_ |= own & lines.inside;
        LaneBits rest = open & ~own;
        if (rest != 0 && planes.towards != 0) {
            // If P is on the camera's side of the triangle's plane, the ray crosses the plane after
            // P.
            rest &= ~(tile_.seen & certainly_on_side(hits_, planes, planes.towards));
        }
        if (rest == 0) {
            return 0;
        }
        const ExactTriangle face{s};
        LaneBits hidden = 0;
        for (; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            hidden |= hides(lane, face) ? LaneBits{1} << lane : 0;
        }
        hidden_ |= hidden;
        return hidden;
    }

    void judge_distances(std::uint32_t /*triangle*/, LaneBits /*asking*/,
                         PacketOf<float>& /*t_far*/) override
    {
    }

private:
    /// The lanes in which GL's triangle is no hit: edge-on, or not beyond the near plane.
    [[nodiscard]] LaneBits nowhere_hit()
    {
        LaneBits nowhere = 0;
        for (LaneBits rest = tile_.seen & ~certainly_beyond(tile_.hits, setting_.near_m); rest != 0;
             rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            const Receiver& receiver = tile_.receiver(lane);
            if (receiver.delta_sign == 0 || !is_beyond(receiver, setting_.near_m, counts_)) {
                nowhere |= LaneBits{1} << lane;
            }
        }
        return nowhere;
    }

    /// The rays' directions, as points.
    [[nodiscard]] LanePositions directions() const
    {
        LanePositions lanes;
        lanes.position = tile_.rays.direction;
        lanes.error.fill(0);
        return lanes;
    }

    /// Whether the lane's ray meets the triangle before its receiver, or has no receiver.
    [[nodiscard]] bool hides(std::size_t lane, const ExactTriangle& face)
    {
        const CameraRay ray = tile_.rays.ray(lane);
        Receiver hit;
        return is_hit(ray, face, setting_.near_m, counts_, hit) &&
               ((tile_.seen >> lane & 1U) == 0 ||
                compare_distance(hit, tile_.receiver(lane), counts_) < 0);
    }

    Setting setting_;
    const Tile& tile_;
    SignCounts& counts_;
    LanePoints points_;    ///< on the camera rays
    LanePoints hits_;      ///< P, for lanes in `seen`
    LaneBits covered_ = 0; ///< lanes in which T certainly covers the pixel's centre
    LaneBits hidden_ = 0;
};

/// The first hits of one ray, ties included.
class NearestHits final : public CandidateTest {
public:
    NearestHits(const ReferenceScene::Implementation& reference, const CameraRay& ray,
                double near_m, SignCounts& counts)
        : reference_{reference},
          ray_{ray},
          near_m_{near_m},
          counts_{counts},
          proxy_{ray, reference.frame}
    {
    }

    std::vector<std::uint32_t> find()
    {
        RTCRayHit single{};
        set_ray(single.ray, proxy_.ray(infinity));
        single.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        reference_.find_candidates(single, *this);
        return std::move(triangles_);
    }

    LaneBits judge_packet(std::uint32_t /*triangle*/, LaneBits /*asking*/) override { return 0; }

    void judge_distances(std::uint32_t triangle, LaneBits /*asking*/,
                         PacketOf<float>& t_far) override
    {
        const ExactTriangle face{reference_.triangles, triangle};
        Receiver hit;
        if (!is_hit(ray_, face, near_m_, counts_, hit)) {
            return;
        }
        const Sign order = triangles_.empty() ? -1 : compare_distance(hit, nearest_, counts_);
        if (order < 0) {
            triangles_.clear();
            nearest_face_ = face;
            nearest_ = Receiver{nearest_face_, ray_, counts_};
        }
        if (order <= 0) {
            triangles_.push_back(triangle);
        }
        t_far[0] = std::min(t_far[0], proxy_.t_beyond(nearest_));
    }

private:
    const ReferenceScene::Implementation& reference_;
    const CameraRay& ray_;
    double near_m_;
    SignCounts& counts_;
    CameraProxyRays proxy_;
    std::vector<std::uint32_t> triangles_; ///< all at the same distance
    ExactTriangle nearest_face_;
    Receiver nearest_;
};

} // namespace

FirstHits::FirstHits(const ReferenceScene::Implementation& reference, const scene::View& view,
                     const renderers::RasterFacts& facts)
    : reference_{reference},
      near_m_{receiver_near_m(reference.bounds)},
      ray_bundle_{reference.frame, view.camera},
      has_eye_{view.camera.projection == scene::Projection::perspective},
      raster_{reference.triangles, view, reference.bounds, facts}
{
}

LaneBits FirstHits::match(const Tile& tile, const LanePositions& points, SignCounts& counts) const
{
    return FirstHitTest{{reference_, ray_bundle_, has_eye_, near_m_}, tile, points, counts}.match();
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
    const ExactTriangle face{reference_.triangles, triangle};
    Receiver hit;
    const bool is_seen = is_hit(ray, face, near_m_, counts, hit);
    if (raster_.coverage_may_differ(triangle, x, y, is_seen)) {
        return unmatched(ClassReason::snap);
    }
    return unmatched(is_seen && !first.empty() && raster_.is_tie(first.front(), triangle, x, y)
                         ? ClassReason::tie
                         : ClassReason::mismatch);
}

scene::Image<std::uint32_t> first_triangles(const ReferenceScene& reference,
                                            const scene::View& view, int threads)
{
    const ReferenceScene::Implementation& implementation = reference.implementation();
    const FirstHits hits{implementation, view, {}};
    scene::Image<std::uint32_t> first{view.image, scene::no_triangle};
    tbb::task_arena arena{threads > 0 ? threads : tbb::task_arena::automatic};
    arena.execute([&] {
        tbb::parallel_for(0, view.image.height_px, [&](int y) {
            SignCounts ignored;
            for (int x = 0; x < view.image.width_px; ++x) {
                const CameraRay ray{scene::pixel_ray(view.camera, view.image, x, y)};
                const auto met = hits.first_hits(ray, ignored);
                first(x, y) = met.empty() ? scene::no_triangle : std::ranges::min(met);
            }
        });
    });
    implementation.errors.check("first_triangles");
    return first;
}

} // namespace gnomon::reference_rt
