#include "reference_rt/traversal/embree_scene.hpp"

#include "reference_rt/traversal/lane_rays.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <tbb/task_arena.h>

#include <cstring>
#include <limits>
#include <utility>

namespace gnomon::reference_rt {

using scene::TriangleScene;
using scene::Vec3d;
using scene::Vec3f;

void EmbreeErrors::record(void* self, RTCError code, const char* message) noexcept
{
    auto& errors = *static_cast<EmbreeErrors*>(self);
    const std::scoped_lock lock{errors.mutex_};
    if (errors.code_ != RTC_ERROR_NONE) {
        return;
    }
    errors.code_ = code;
    try {
        errors.message_ = message == nullptr ? "" : message;
    } catch (const std::bad_alloc&) {
        errors.message_.clear(); // the error code is enough
    }
}

void EmbreeErrors::check(const char* during) const
{
    const std::scoped_lock lock{mutex_};
    if (code_ == RTC_ERROR_NONE) {
        return;
    }
    throw scene::EnvironmentError{fmt::format(
        "Embree failed in {}: error {} ({}); {}", during, static_cast<int>(code_), message_,
        code_ == RTC_ERROR_OUT_OF_MEMORY ? "free memory or use a smaller scene"
                                         : "run `gnomon doctor`")};
}

namespace {

embree::Device make_device(const ReferenceOptions& options, EmbreeErrors& errors)
{
    std::string config = fmt::format("threads={}", options.threads);
    if (!options.embree_isa.empty()) {
        config += ",isa=" + options.embree_isa;
    }
    embree::Device device{rtcNewDevice(config.c_str())};
    if (!device) {
        throw scene::EnvironmentError{
            fmt::format("rtcNewDevice failed: error {}; run `gnomon doctor`",
                        static_cast<int>(rtcGetDeviceError(nullptr)))};
    }
    rtcSetDeviceErrorFunction(device.get(), &EmbreeErrors::record, &errors);
    return device;
}

/// The triangles of each pair of roles, by mask.
std::array<std::vector<std::uint32_t>, 4> triangles_by_mask(const TriangleScene& scene,
                                                            std::uint32_t hidden_triangle)
{
    std::array<std::vector<std::uint32_t>, 4> members;
    for (const scene::Object& object : scene.objects) {
        const unsigned mask =
            (object.casts ? unsigned{casters} : 0U) | (object.receives ? unsigned{receivers} : 0U);
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            if (object.first_triangle + i != hidden_triangle) {
                members[mask].push_back(object.first_triangle + i);
            }
        }
    }
    return members;
}

/// Embree's callback for the padded box of a triangle.
void bound_triangle(const RTCBoundsFunctionArguments* arguments) noexcept
{
    const auto& role =
        *static_cast<const ReferenceScene::Implementation::Role*>(arguments->geometryUserPtr);
    const auto& owner = *role.owner;
    const Corners corners = corners_of(owner.triangles, role.members[arguments->primID]);
    const Vec3d a = owner.frame.from_world(corners[0]);
    const Vec3d b = owner.frame.from_world(corners[1]);
    const Vec3d c = owner.frame.from_world(corners[2]);
    const Vec3d padding{owner.faults.padding_share * owner.padding};
    const Vec3f lower{glm::min(a, glm::min(b, c)) - padding};
    const Vec3f upper{glm::max(a, glm::max(b, c)) + padding};
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = lower.x;
    box.lower_y = lower.y;
    box.lower_z = lower.z;
    box.upper_x = upper.x;
    box.upper_y = upper.y;
    box.upper_z = upper.z;
}

/// Calls `visit` with Embree's index and the lane of each active ray. Ids of idle rays are
/// undefined.
template <typename Visit>
void for_each_asking(const int* valid, RTCRayN* rays, unsigned n, const Visit& visit)
{
    for (unsigned i = 0; i < n; ++i) {
        if (valid[i] != 0) {
            visit(i, RTCRayN_id(rays, n, i));
        }
    }
}

GNOMON_WIDEST_VECTORS
LaneBits asking_lanes(const int* valid, RTCRayN* rays, unsigned n)
{
    const unsigned* const ids = &RTCRayN_id(rays, n, 0);
    LaneBits asking = 0;
    for (unsigned i = 0; i < n; ++i) {
        asking |= valid[i] != 0 ? LaneBits{1} << (ids[i] % packet_size) : 0;
    }
    return asking;
}

void judge_packet(const RTCOccludedFunctionNArguments* arguments) noexcept
{
    auto& judge = embree::payload_of<CandidateTest>(*arguments);
    const auto& role =
        *static_cast<const ReferenceScene::Implementation::Role*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    const LaneBits asking = asking_lanes(arguments->valid, arguments->ray, n);
    try {
        const LaneBits settled = judge.judge_packet(role.members[arguments->primID], asking);
        if (settled == 0) {
            return;
        }
        for_each_asking(arguments->valid, arguments->ray, n, [&](unsigned i, unsigned lane) {
            if ((settled >> lane & 1U) != 0) {
                RTCRayN_tfar(arguments->ray, n, i) = -std::numeric_limits<float>::infinity();
            }
        });
    } catch (...) {
        judge.failure = std::current_exception();
    }
}

void judge_distances(const RTCIntersectFunctionNArguments* arguments) noexcept
{
    auto& judge = embree::payload_of<CandidateTest>(*arguments);
    const auto& role =
        *static_cast<const ReferenceScene::Implementation::Role*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
    LaneBits asking = 0;
    PacketOf<float> t_far{};
    for_each_asking(arguments->valid, rays, n, [&](unsigned i, unsigned lane) {
        asking |= LaneBits{1} << lane;
        t_far[lane] = RTCRayN_tfar(rays, n, i);
    });
    const PacketOf<float> t_far_before = t_far;
    try {
        judge.judge_distances(role.members[arguments->primID], asking, t_far);
    } catch (...) {
        judge.failure = std::current_exception();
        return;
    }
    if (t_far == t_far_before) {
        return;
    }
    for_each_asking(arguments->valid, rays, n,
                    [&](unsigned i, unsigned lane) { RTCRayN_tfar(rays, n, i) = t_far[lane]; });
}

/// Filters hits of float rays with native triangles.
struct NativeHits {
    const ReferenceScene::Implementation& reference;
    const PacketOf<Receiver>* own;
};

void reject_own_triangle(const RTCFilterFunctionNArguments* arguments) noexcept
{
    const auto& hits = embree::payload_of<NativeHits>(*arguments);
    for_each_asking(arguments->valid, arguments->ray, arguments->N, [&](unsigned i, unsigned lane) {
        const std::uint32_t triangle =
            hits.reference.triangle(RTCHitN_geomID(arguments->hit, arguments->N, i),
                                    RTCHitN_primID(arguments->hit, arguments->N, i));
        if ((*hits.own)[lane].triangle() == triangle) {
            arguments->valid[i] = 0;
        }
    });
}

/// Writes the rays of `lanes`, and disables the others as `idle_other_lanes` does.
GNOMON_WIDEST_VECTORS
void fill_packet(LaneBits lanes, const FloatRays& rays, RayMask mask, PacketMask& valid,
                 RTCRay16& packet)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < packet_size; ++i) {
        const bool takes_part = (lanes >> i & 1U) != 0;
        valid.lane[i] = takes_part ? -1 : 0;
        packet.org_x[i] = takes_part ? rays.origin_x[i] : 0;
        packet.org_y[i] = takes_part ? rays.origin_y[i] : 0;
        packet.org_z[i] = takes_part ? rays.origin_z[i] : 0;
        packet.dir_x[i] = takes_part ? embree_component(rays.direction_x[i]) : 1;
        packet.dir_y[i] = takes_part ? embree_component(rays.direction_y[i]) : 1;
        packet.dir_z[i] = takes_part ? embree_component(rays.direction_z[i]) : 1;
        packet.tnear[i] = takes_part ? 0 : infinity;
        packet.tfar[i] = takes_part ? rays.t_far[i] : -infinity;
        packet.mask[i] = takes_part ? unsigned{mask} : 0U;
        packet.time[i] = 0;
        packet.id[i] = static_cast<unsigned>(i);
        packet.flags[i] = 0;
    }
}

void rethrow_failure(const CandidateTest& judge)
{
    if (judge.failure) {
        std::rethrow_exception(judge.failure);
    }
}

} // namespace

ReferenceScene::Implementation::Implementation(const TriangleScene& scene_in,
                                               const ReferenceOptions& options,
                                               const Faults& faults_in)
    : faults{faults_in},
      triangles{scene_in},
      bounds{scene_in.bounds()},
      frame{bounds},
      padding{box_padding + frame.scale() * options.start_error_m},
      device{make_device(options, errors)}
{
    // Embree reads 16 bytes for each 12-byte vertex, so the last one needs readable bytes after it.
    triangles.vertices.reserve(triangles.vertices.size() + 1);
    auto members = triangles_by_mask(triangles, faults.hidden_triangle);
    for (unsigned mask = 1; mask < members.size(); ++mask) {
        if (!members[mask].empty()) {
            roles.push_back({this, mask, std::move(members[mask])});
        }
    }
    if (options.serves_plain_rays) {
        native = build(&Implementation::fill_native, RTC_GEOMETRY_TYPE_TRIANGLE);
    }
    if (options.serves_exact_truth) {
        padded = build(&Implementation::fill_padded, RTC_GEOMETRY_TYPE_USER);
    }
}

embree::Scene ReferenceScene::Implementation::build(void (Implementation::*fill)(RTCGeometry,
                                                                                 const Role&),
                                                    RTCGeometryType type)
{
    embree::Scene scene{rtcNewScene(device.get())};
    errors.check("rtcNewScene");
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | embree::filtering_scene);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    for (unsigned id = 0; id < roles.size(); ++id) {
        const embree::Geometry geometry{rtcNewGeometry(device.get(), type)};
        errors.check("rtcNewGeometry");
        (this->*fill)(geometry.get(), roles[id]);
        rtcSetGeometryMask(geometry.get(), roles[id].mask);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene.get(), geometry.get(), id);
        errors.check("rtcAttachGeometryByID");
    }
    rtcCommitScene(scene.get());
    errors.check("rtcCommitScene");
    return scene;
}

void ReferenceScene::Implementation::fill_native(RTCGeometry geometry, const Role& role)
{
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               triangles.vertices.data(), 0, sizeof(Vec3f),
                               triangles.vertices.size());
    constexpr std::size_t bytes_per_triangle = sizeof(triangles.triangles[0]);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                bytes_per_triangle, role.members.size()));
    errors.check("rtcSetNewGeometryBuffer");
    for (std::size_t i = 0; i < role.members.size(); ++i) {
        std::memcpy(indices + 3 * i, triangles.triangles[role.members[i]].data(),
                    bytes_per_triangle);
    }
}

void ReferenceScene::Implementation::fill_padded(RTCGeometry geometry, const Role& role)
{
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(role.members.size()));
    // Embree passes the pointer to callbacks, which only read.
    rtcSetGeometryUserData(geometry, const_cast<Role*>(&role));
    rtcSetGeometryBoundsFunction(geometry, &bound_triangle, nullptr);
    rtcSetGeometryOccludedFunction(geometry, &judge_packet);
    rtcSetGeometryIntersectFunction(geometry, &judge_distances);
}

const CornerFans& ReferenceScene::Implementation::corner_fans() const
{
    // Isolated, so that a thread waiting for the sort does not start a task that needs the fans.
    std::call_once(corner_fans_made_, [&] {
        tbb::this_task_arena::isolate(
            [&] { corner_fans_ = std::make_unique<const CornerFans>(triangles); });
    });
    return *corner_fans_;
}

void ReferenceScene::Implementation::find_candidates(LaneBits lanes, const FloatRays& rays,
                                                     RayMask mask, CandidateTest& judge) const
{
    PacketMask valid;
    RTCRay16 packet;
    fill_packet(lanes, rays, mask, valid, packet);
    embree::Query query{embree::Coherence::coherent, nullptr, &judge};
    embree::occluded16(valid.lane.data(), padded.get(), query, packet);
    rethrow_failure(judge);
}

void ReferenceScene::Implementation::find_candidates(const PacketMask& valid, RTCRayHit16& rays,
                                                     CandidateTest& judge) const
{
    idle_other_lanes(rays.ray, valid);
    embree::Query query{embree::Coherence::coherent, nullptr, &judge};
    embree::intersect16(valid.lane.data(), padded.get(), query, rays);
    rethrow_failure(judge);
}

void ReferenceScene::Implementation::find_candidates(RTCRayHit& ray, CandidateTest& judge) const
{
    embree::Query query{embree::Coherence::incoherent, nullptr, &judge};
    embree::intersect1(padded.get(), query, ray);
    rethrow_failure(judge);
}

PacketMask ReferenceScene::Implementation::find_occluded(const PacketMask& valid, RTCRay16& rays,
                                                         const PacketOf<Receiver>* own) const
{
    idle_other_lanes(rays, valid);
    NativeHits hits{*this, own};
    embree::Query query{embree::Coherence::coherent,
                        own != nullptr ? &reject_own_triangle : nullptr, &hits};
    embree::occluded16(valid.lane.data(), native.get(), query, rays);
    PacketMask occluded;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i] && rays.tfar[i] < 0) { // Embree sets tfar to −∞ for occluded rays
            occluded.add(i);
        }
    }
    return occluded;
}

ReferenceScene::ReferenceScene(const TriangleScene& triangles, const ReferenceOptions& options)
    : implementation_{std::make_unique<Implementation>(triangles, options)}
{
}
ReferenceScene::ReferenceScene(std::unique_ptr<Implementation> implementation)
    : implementation_{std::move(implementation)}
{
}
ReferenceScene::~ReferenceScene() = default;
ReferenceScene::ReferenceScene(ReferenceScene&&) noexcept = default;
ReferenceScene& ReferenceScene::operator=(ReferenceScene&&) noexcept = default;

const TriangleScene& ReferenceScene::triangles() const
{
    return implementation_->triangles;
}

} // namespace gnomon::reference_rt
