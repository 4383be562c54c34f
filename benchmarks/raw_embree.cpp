#include "raw_embree.hpp"

#include "reference_rt/traversal/embree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace gnomon::benchmarks {
namespace {

namespace embree = reference_rt::embree;

constexpr int tile_px = 4;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Packet {
    std::array<int, 16> valid{};
    RTCRay16 rays{};
};

void set_ray(Packet& packet, std::size_t lane, const scene::Vec3f& origin,
             const scene::Vec3f& towards_light, float near, float far)
{
    packet.valid[lane] = -1;
    packet.rays.org_x[lane] = origin.x;
    packet.rays.org_y[lane] = origin.y;
    packet.rays.org_z[lane] = origin.z;
    packet.rays.dir_x[lane] = towards_light.x;
    packet.rays.dir_y[lane] = towards_light.y;
    packet.rays.dir_z[lane] = towards_light.z;
    packet.rays.tnear[lane] = near;
    packet.rays.tfar[lane] = far;
    packet.rays.mask[lane] = 0xFFFFFFFF;
}

/// Embree requires packets aligned to 64 bytes, which RTCRay16 declares and vector respects.
using Packets = std::vector<Packet>;

} // namespace

struct RawEmbreePass::State {
    embree::Device device{rtcNewDevice(nullptr)};
    embree::Scene scene{rtcNewScene(device.get())};
    Packets packets; ///< as built
    Packets scratch; ///< traced; Embree overwrites the rays
    std::size_t rays = 0;
};

RawEmbreePass::RawEmbreePass(const scene::TriangleScene& triangles, const scene::View& view,
                             const scene::Truth& truth, const scene::Image<scene::Vec3f>& points)
    : state_{std::make_unique<State>()}
{
    const embree::Geometry geometry{
        rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE)};
    auto* vertices = static_cast<scene::Vec3f*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(scene::Vec3f), triangles.vertices.size()));
    std::copy(triangles.vertices.begin(), triangles.vertices.end(), vertices);
    using Corner = std::array<std::uint32_t, 3>;
    auto* indices = static_cast<Corner*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(Corner), triangles.triangles.size()));
    std::copy(triangles.triangles.begin(), triangles.triangles.end(), indices);
    rtcSetGeometryMask(geometry.get(), 0xFFFFFFFF);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(state_->scene.get(), geometry.get());
    rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(state_->scene.get());

    const auto diagonal_m = static_cast<float>(triangles.bounds().diagonal_m());
    const bool spot = view.light.has_position();
    const scene::Vec3f to_directional{-view.light.direction};
    const scene::Vec3f spot_position{view.light.position};
    for (int y0 = 0; y0 < view.image.height_px; y0 += tile_px) {
        for (int x0 = 0; x0 < view.image.width_px; x0 += tile_px) {
            Packet packet;
            std::ranges::fill(packet.rays.tfar, -infinity); // idle at any mask
            for (int lane = 0; lane < tile_px * tile_px; ++lane) {
                const int x = x0 + lane % tile_px;
                const int y = y0 + lane / tile_px;
                if (x < view.image.width_px && y < view.image.height_px &&
                    is_scored(truth.pixel_class(x, y))) {
                    const scene::Vec3f origin = points(x, y);
                    const scene::Vec3f towards = spot ? spot_position - origin : to_directional;
                    const float length = std::sqrt(towards.x * towards.x + towards.y * towards.y +
                                                   towards.z * towards.z);
                    set_ray(packet, static_cast<std::size_t>(lane), origin, towards,
                            1e-4F * diagonal_m / length, spot ? 1.0F : infinity);
                    ++state_->rays;
                }
            }
            state_->packets.push_back(packet);
        }
    }
    state_->scratch = state_->packets;
}

RawEmbreePass::~RawEmbreePass() = default;

std::size_t RawEmbreePass::ray_count() const
{
    return state_->rays;
}

std::size_t RawEmbreePass::run()
{
    State& state = *state_;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>{0, state.packets.size(), 64}, std::size_t{0},
        [&](const tbb::blocked_range<std::size_t>& range, std::size_t occluded) {
            embree::Query query{embree::Coherence::coherent};
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                Packet& packet = state.scratch[i];
                std::copy(std::begin(state.packets[i].rays.tfar),
                          std::end(state.packets[i].rays.tfar), std::begin(packet.rays.tfar));
                embree::occluded16(packet.valid.data(), state.scene.get(), query, packet.rays);
                for (std::size_t lane = 0; lane < 16; ++lane) {
                    occluded += packet.valid[lane] != 0 && packet.rays.tfar[lane] < 0 ? 1U : 0U;
                }
            }
            return occluded;
        },
        std::plus<>{});
}

} // namespace gnomon::benchmarks
