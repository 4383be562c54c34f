#include "reference_rt/light/texel_first_hits.hpp"

#include "reference_rt/exact/crossing_depth.hpp"
#include "reference_rt/exact/triangle_contact.hpp"
#include "reference_rt/traversal/proxy_rays.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::reference_rt {

using renderers::HitDetail;
using renderers::TexelHit;
using scene::no_triangle;
using scene::Texel;

namespace {

/// The stored part of a hit. The rest is recomputed if doubles do not decide.
struct KeptHit {
    std::uint32_t triangle = no_triangle;
    double t = 0;
    double t_error = 0;
    Interval depth;

    /// −1 if `hit` is certainly nearer, 1 if certainly farther, else 0.
    [[nodiscard]] Sign certain_order(const Receiver& hit) const
    {
        if (triangle == no_triangle) {
            return -1;
        }
        const Interval difference = Interval{hit.t, hit.t_error} - Interval{t, t_error};
        return static_cast<Sign>(difference.is_certainly_positive()) -
               static_cast<Sign>(difference.is_certainly_negative());
    }
};

/// The rays of a packet of texels during Embree's traversal.
class TexelPacket final : public CandidateTest {
public:
    struct Setting {
        const ReferenceScene::Implementation& reference;
        const TexelRays& rays;
        const LightDepth& depth;
        const LightDistance* distance; ///< the distance that maps store instead of depths, or null
        scene::Cull cull;
        const RayBundle& ray_bundle;
    };

    explicit TexelPacket(const Setting& setting) : setting_{setting}
    {
        proxy_rays_.reserve(packet_size);
    }

    /// Traces new texels.
    void trace(std::span<const Texel> texels)
    {
        front_.fill({});
        trace_on(texels);
    }
    /// Traces behind the hits of `trace`, which must have run with these texels.
    void trace_behind(std::span<const Texel> texels)
    {
        front_ = nearest_;
        trace_on(texels);
    }

    [[nodiscard]] TexelHit result(std::size_t lane, HitDetail detail)
    {
        const KeptHit& kept = nearest_[lane];
        if (kept.triangle == no_triangle) {
            return {no_triangle, setting_.depth.is_reversed() ? 0.0 : 1.0,
                    std::numeric_limits<double>::infinity()};
        }
        const bool has_depth = setting_.distance == nullptr;
        if (has_depth && detail == HitDetail::bounded && kept.depth.error <= 0x1p-40) {
            return {kept.triangle, kept.depth.value, std::numeric_limits<double>::quiet_NaN(),
                    kept.depth.error};
        }
        const ExactTriangle face = face_of(kept.triangle);
        const Receiver hit{face, rays_[lane], counts_};
        auto [depth, light_distance_m] = setting_.depth.place(hit, place_memory_);
        if (!has_depth) {
            depth = setting_.distance->place(hit);
        }
        return {kept.triangle, depth.value, light_distance_m, depth.error};
    }

    LaneBits judge_packet(std::uint32_t /*triangle*/, LaneBits /*asking*/) override { return 0; }

    void judge_distances(std::uint32_t triangle, LaneBits asking, PacketOf<float>& t_far) override
    {
        const SceneTriangle s = triangle_of(setting_.reference.triangles, triangle);
        const TrianglePlanes planes =
            make_planes(setting_.reference.frame, setting_.ray_bundle, s,
                        setting_.rays.has_positional() ? LaneKind::directions : LaneKind::points);
        const LineVerdicts lines = judge_lines(points_, planes);
        LaneBits open = asking & ~lines.outside;
        if (open == 0 ||
            (planes.towards != 0 && !is_kept_by_culling(setting_.cull, planes.towards))) {
            return;
        }
        const ExactTriangle face{s};
        const auto first = static_cast<std::size_t>(std::countr_zero(open));
        const Filtered<8> positional_nu = nu_of(face, rays_[first].ray.origin);
        for (; open != 0; open &= open - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(open));
            const Receiver hit = setting_.rays.has_positional()
                                     ? Receiver{face, rays_[lane], positional_nu, counts_}
                                     : Receiver{face, rays_[lane], counts_};
            if (meet(lane, hit, (lines.inside >> lane & 1U) != 0)) {
                t_far[lane] = std::min(t_far[lane], proxy_rays_[lane].t_beyond(hit));
            }
        }
    }

private:
    void trace_on(std::span<const Texel> texels)
    {
        assert(!texels.empty() && texels.size() <= packet_size);
        RTCRayHit16 packet;
        PacketMask valid;
        nearest_.fill({});
        edges_.clear();
        proxy_rays_.clear();
        for (std::size_t i = 0; i < texels.size(); ++i) {
            rays_[i] = CameraRay{setting_.rays.ray(texels[i])};
            lines_[i] = setting_.depth.plainly_along(rays_[i].ray);
            const CameraProxyRays& proxy =
                proxy_rays_.emplace_back(rays_[i], setting_.reference.frame);
            if (setting_.rays.has_positional()) {
                points_.set(i, rays_[i].ray.direction, 0);
            } else {
                points_.set(i, proxy.origin().position, proxy.origin().error);
            }
            // Rounding of the origin may put a triangle in the near plane before it, by less than
            // the padding allows for.
            set_lane(packet.ray, i, proxy.ray(std::numeric_limits<float>::infinity(), casters));
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            valid.add(i);
        }
        setting_.reference.find_candidates(valid, packet, *this);
    }

    struct EdgeContact {
        std::size_t lane;
        std::uint32_t triangle;
        int edge;
    };

    [[nodiscard]] ExactTriangle face_of(std::uint32_t triangle) const
    {
        return {setting_.reference.triangles, triangle};
    }

    /// Returns whether the hit, or its seam with an earlier one, bounds the search.
    bool meet(std::size_t lane, const Receiver& hit, bool is_inside)
    {
        // In front of the light a ray arrives on the side of n·(−d) = −δ.
        const KeptHit& kept = nearest_[lane];
        if (!is_kept_by_culling(setting_.cull, -hit.delta_sign) || kept.certain_order(hit) > 0 ||
            !is_behind_front(lane, hit)) {
            return false;
        }
        const TriangleContact contact =
            is_inside ? TriangleContact{Contact::cross} : hit_of(rays_[lane], *hit.face, counts_);
        if (contact.kind != Contact::cross && contact.kind != Contact::edge) {
            return false; // vertices do not count
        }
        const Interval depth = setting_.depth.at(lines_[lane], parameter_of(hit));
        if (!setting_.depth.is_in_range(lines_[lane], hit, depth)) {
            return false;
        }
        if (contact.kind == Contact::cross) {
            keep_nearer(lane, hit, depth, hit.triangle());
            return true;
        }
        return meet_edge(lane, hit, depth, contact.edge);
    }

    /// Keeps `triangle`, hit at `hit`, if it is nearer.
    void keep_nearer(std::size_t lane, const Receiver& hit, const Interval& depth,
                     std::uint32_t triangle)
    {
        KeptHit& kept = nearest_[lane];
        const Sign certain = kept.certain_order(hit);
        const Sign order = certain != 0 ? certain : compare(lane, hit, kept);
        if (order < 0) {
            kept = {triangle, hit.t, hit.t_error, depth};
        } else if (order == 0) {
            kept.triangle = std::min(kept.triangle, triangle);
        }
    }

    /// −1 if `hit` is exactly nearer than the kept one, 1 if farther, else 0.
    [[nodiscard]] Sign compare(std::size_t lane, const Receiver& hit, const KeptHit& kept)
    {
        const ExactTriangle face = face_of(kept.triangle);
        return compare_distance(hit, Receiver{face, rays_[lane], counts_}, counts_);
    }

    /// Whether the hit lies behind the front hit, if there is one.
    [[nodiscard]] bool is_behind_front(std::size_t lane, const Receiver& hit)
    {
        const KeptHit& front = front_[lane];
        if (front.triangle == no_triangle) {
            return true;
        }
        const Sign certain = front.certain_order(hit);
        return (certain != 0 ? certain : compare(lane, hit, front)) > 0;
    }

    bool meet_edge(std::size_t lane, const Receiver& hit, const Interval& depth, int edge)
    {
        const EdgeOf own = edge_of(hit.corners(), edge);
        bool is_seam = false;
        for (const EdgeContact& other : edges_) {
            const auto corners = corners_of(setting_.reference.triangles, other.triangle);
            if (other.lane == lane &&
                forms_seam(own, edge_of(corners, other.edge), setting_.rays.light(), counts_)) {
                keep_nearer(lane, hit, depth, std::min(hit.triangle(), other.triangle));
                is_seam = true;
            }
        }
        edges_.push_back({lane, hit.triangle(), edge});
        return is_seam;
    }

    Setting setting_;
    SignCounts counts_;
    LanePoints points_;
    PacketOf<CameraRay> rays_;
    PacketOf<ClipLine> lines_;
    std::vector<CameraProxyRays> proxy_rays_;
    PacketOf<KeptHit> nearest_;
    PacketOf<KeptHit> front_; ///< the search is behind these hits
    std::vector<EdgeContact> edges_;
    LightDepth::PlaceMemory place_memory_;
};

} // namespace

void TexelFirstHits::find(std::span<const Texel> texels, std::span<TexelHit> hits) const
{
    TexelPacket packet{{reference_, rays_, depth_, distance_, cull_, ray_bundle_}};
    for (std::size_t first = 0; first < texels.size(); first += packet_size) {
        const std::size_t count = std::min(packet_size, texels.size() - first);
        packet.trace(texels.subspan(first, count));
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i] = packet.result(i, detail_);
        }
    }
}

void TexelFirstHits::find_second(std::span<const Texel> texels, std::span<TexelHit> hits) const
{
    TexelPacket packet{{reference_, rays_, depth_, distance_, cull_, ray_bundle_}};
    for (std::size_t first = 0; first < texels.size(); first += packet_size) {
        const std::size_t count = std::min(packet_size, texels.size() - first);
        packet.trace(texels.subspan(first, count));
        packet.trace_behind(texels.subspan(first, count));
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i] = packet.result(i, detail_);
        }
    }
}

using renderers::TexelHit;
using scene::LightFrustum;
using scene::no_triangle;
using scene::Ray;
using scene::Texel;
using scene::Vec3d;

namespace {

/// Whether two frusta have equal texel rays for a spot light.
bool has_same_rays(const LightFrustum& a, const LightFrustum& b)
{
    const ClipRows rows_a{a};
    const ClipRows rows_b{b};
    return rows_a.x == rows_b.x && rows_a.y == rows_b.y && rows_a.w == rows_b.w &&
           a.forward == b.forward;
}

/// Whether two frusta have equal texel rays, near and far planes, for any light.
bool has_same_view(const LightFrustum& a, const LightFrustum& b)
{
    return a.light_clip_from_world == b.light_clip_from_world && a.reversed == b.reversed &&
           a.forward == b.forward;
}

/// The ray parameter of a frustum's near plane; unbounded if the ray does not cross near before
/// far.
Interval near_parameter(const LightFrustum& frustum, const Ray& ray)
{
    const ClipLine line = LightDepth{frustum}.plainly_along(ray);
    // Depth is 0 (reversed: 1) at near, and at the other end of its range at far.
    const Interval near_start =
        frustum.reversed ? line.w_start - line.z_start : line.z_start + line.w_start;
    const Interval near_step =
        frustum.reversed ? line.w_step - line.z_step : line.z_step + line.w_step;
    const Interval far_step = frustum.reversed ? line.z_step : line.w_step - line.z_step;
    const bool is_before_the_ray = near_start.is_certainly_negative() &&
                                   near_step.is_certainly_positive() &&
                                   far_step.is_certainly_negative();
    return is_before_the_ray ? Interval{0, 0} - near_start / near_step
                             : Interval{0, std::numeric_limits<double>::infinity()};
}

/// A spot light's ray through a corner of the map.
Ray corner_ray(const LightFrustum& frustum, const scene::Light& light, double u, double v)
{
    const ClipRows rows{frustum};
    const Vec3d across = glm::cross(Vec3d{rows.x - u * rows.w}, Vec3d{rows.y - v * rows.w});
    return {light.position, glm::dot(across, frustum.forward) < 0 ? -across : across};
}

} // namespace

bool keeps_first_hits(const scene::Light& light, const LightFrustum& from, const LightFrustum& to)
{
    if (has_same_view(from, to)) {
        return true;
    }
    if (!light.has_position() || !has_same_rays(from, to)) {
        return false;
    }
    constexpr std::array<std::array<double, 2>, 4> corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    return std::ranges::all_of(corners, [&](const auto& corner) {
        const Ray ray = corner_ray(from, light, corner[0], corner[1]);
        return (near_parameter(to, ray) - near_parameter(from, ray)).is_certainly_positive();
    });
}

void KnownHitPlacer::place(std::span<const Texel> texels, std::span<const std::uint32_t> triangles,
                           std::span<TexelHit> hits) const
{
    assert(texels.size() == triangles.size() && texels.size() == hits.size());
    SignCounts counts;
    LightDepth::PlaceMemory memory;
    ExactTriangle face;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (triangles[i] == no_triangle) {
            continue;
        }
        if (triangles[i] != face.triangle) {
            face = {triangles_, triangles[i]};
        }
        const CameraRay ray{rays_.ray(texels[i])};
        const Receiver hit{face, ray, counts};
        const ClipLine line = depth_.plainly_along(ray.ray);
        if (depth_.is_in_range(line, hit, depth_.at(line, parameter_of(hit)))) {
            auto [depth, light_distance_m] = depth_.place(hit, memory);
            if (distance_ != nullptr) {
                depth = distance_->place(hit);
            }
            hits[i] = {triangles[i], depth.value, light_distance_m, depth.error};
        }
    }
}

} // namespace gnomon::reference_rt
