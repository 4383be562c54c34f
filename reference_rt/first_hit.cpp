#include "reference_rt/first_hit.hpp"

#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::no_triangle;
using scene::PixelClass;
using scene::Ray;
using scene::Vec3f;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

FirstHitVerdict unmatched(ClassReason reason)
{
    return {false, PixelClass::unmatched, reason};
}

} // namespace

/// The payload of `judge`: one ray, and the nearest hit that double arithmetic confirmed.
struct FirstHits::Search {
    const FirstHits& first_hits;
    const Ray& ray;
    std::optional<Candidate> nearest;
};

FirstHits::FirstHits(const ReferenceScene::Implementation& reference, const scene::View& view,
                     const RasterFacts& facts)
    : reference_{reference},
      near_m_{receiver_near_m(reference.bounds)},
      raster_{view.camera, view.image, reference.bounds, facts}
{
}

PacketOf<std::uint32_t> FirstHits::trace(const PacketMask& valid, const PacketOf<Ray>& rays) const
{
    RTCRayHit16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i]) {
            // d·forward = 1, so that t is the eye distance in which the near plane is given.
            set_lane(packet.ray, i,
                     {Vec3f{rays[i].origin}, Vec3f{rays[i].direction}, static_cast<float>(near_m_),
                      infinity, receivers});
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
    }
    embree::Query query{embree::Coherence::coherent};
    embree::intersect16(valid.lane.data(), reference_.scene.get(), query, packet);
    PacketOf<std::uint32_t> hits;
    for (std::size_t i = 0; i < packet_size; ++i) {
        hits[i] = valid[i] && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID
                      ? reference_.triangle(packet.hit.geomID[i], packet.hit.primID[i])
                      : no_triangle;
    }
    return hits;
}

std::optional<FirstHits::Candidate> FirstHits::candidate(const Ray& ray,
                                                         std::uint32_t triangle) const
{
    const auto hit = camera_hit(ray, corners_of(reference_.triangles, triangle));
    if (!hit || hit->t <= near_m_) {
        return std::nullopt;
    }
    return Candidate{triangle, *hit};
}

void FirstHits::judge(const RTCFilterFunctionNArguments* arguments) noexcept
{
    auto& search = embree::payload_of<Search>(*arguments);
    const FirstHits& first_hits = search.first_hits;
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const auto found = first_hits.candidate(
            search.ray,
            first_hits.reference_.triangle(RTCHitN_geomID(arguments->hit, arguments->N, i),
                                           RTCHitN_primID(arguments->hit, arguments->N, i)));
        if (!found) {
            arguments->valid[i] = 0;
        } else if (!search.nearest || found->hit.t < search.nearest->hit.t) {
            search.nearest = found;
        }
    }
}

std::optional<FirstHits::Candidate> FirstHits::nearest(const Ray& ray) const
{
    RTCRayHit single{};
    single.ray.org_x = static_cast<float>(ray.origin.x);
    single.ray.org_y = static_cast<float>(ray.origin.y);
    single.ray.org_z = static_cast<float>(ray.origin.z);
    single.ray.dir_x = static_cast<float>(ray.direction.x);
    single.ray.dir_y = static_cast<float>(ray.direction.y);
    single.ray.dir_z = static_cast<float>(ray.direction.z);
    single.ray.tfar = infinity;
    single.ray.mask = receivers;
    single.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Search search{*this, ray, std::nullopt};
    embree::Query query{embree::Coherence::incoherent, &FirstHits::judge, &search};
    embree::intersect1(reference_.scene.get(), query, single);
    return search.nearest;
}

bool FirstHits::is_tie(const Ray& ray, int x, int y, const Candidate& seen,
                       const Candidate& nearest) const
{
    const double gap = std::abs(raster_.depth(ray.origin + seen.hit.t * ray.direction) -
                                raster_.depth(ray.origin + nearest.hit.t * ray.direction));
    return gap <= raster_.depth_error(corners_of(reference_.triangles, seen.triangle), x, y) +
                      raster_.depth_error(corners_of(reference_.triangles, nearest.triangle), x, y);
}

FirstHitVerdict FirstHits::settle(const Ray& ray, int x, int y, std::uint32_t triangle) const
{
    const auto first = nearest(ray);
    const auto is_snapped = [&](std::uint32_t candidate) {
        return raster_.is_near_edge(corners_of(reference_.triangles, candidate), x, y);
    };
    if (triangle == no_triangle) {
        if (!first) {
            return {false, PixelClass::background, ClassReason::none};
        }
        return unmatched(is_snapped(first->triangle) ? ClassReason::snap : ClassReason::mismatch);
    }
    const auto seen = candidate(ray, triangle);
    // The pixel's centre on a shared edge has two first hits, equal but for t's rounding.
    if (seen && (!first || seen->hit.t - seen->hit.t_error <= first->hit.t + first->hit.t_error)) {
        return {true, PixelClass::lit, ClassReason::none};
    }
    if (seen && is_tie(ray, x, y, *seen, *first)) {
        return unmatched(ClassReason::tie);
    }
    if (is_snapped(triangle) || (first && is_snapped(first->triangle))) {
        return unmatched(ClassReason::snap);
    }
    return unmatched(ClassReason::mismatch);
}

} // namespace gnomon::reference_rt
