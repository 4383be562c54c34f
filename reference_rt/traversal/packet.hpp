#pragma once

#include "scene/camera/camera.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::reference_rt {

/// Rays are traced in packets of 4×4 pixels.
inline constexpr int tile_side_px = 4;
inline constexpr std::size_t packet_size = tile_side_px * tile_side_px;

template <typename Value>
using PacketOf = std::array<Value, packet_size>;

/// A set of lanes as bits.
using LaneBits = std::uint32_t;

/// −1 for active lanes, else 0; aligned for Embree.
struct alignas(64) PacketMask {
    PacketOf<int> lane{};

    [[nodiscard]] bool operator[](std::size_t i) const { return lane[i] != 0; }
    void add(std::size_t i) { lane[i] = -1; }
    [[nodiscard]] bool any() const
    {
        for (const int is_valid : lane) {
            if (is_valid != 0) {
                return true;
            }
        }
        return false;
    }
};

/// Bits of Embree's ray and geometry masks.
enum RayMask : unsigned {
    casters = 1U << 0,   ///< shadow rays
    receivers = 1U << 1, ///< camera rays
};

/// A ray in Embree's precision, from t_near to t_far in units of its direction.
struct FloatRay {
    scene::Vec3f origin;
    scene::Vec3f direction;
    float t_near = 0;
    float t_far = 0;
    unsigned mask = 0;
};

/// A direction component for Embree, with tiny values flushed to +0. Embree 3.13 derives a coherent
/// packet's octant from the signs, then replaces smaller components by +1e-18: one lane's −1e-20
/// made all sixteen miss boxes. `box_padding` allows for 1e-17.
[[nodiscard]] inline float embree_component(float component)
{
    constexpr float replaced = 2e-18F;
    return component > -replaced && component < replaced ? 0.0F : component;
}

/// Writes a ray into a lane of Embree's packet, with the lane as its id.
template <typename Ray16>
void set_lane(Ray16& rays, std::size_t lane, const FloatRay& ray)
{
    rays.org_x[lane] = ray.origin.x;
    rays.org_y[lane] = ray.origin.y;
    rays.org_z[lane] = ray.origin.z;
    rays.tnear[lane] = ray.t_near;
    rays.dir_x[lane] = embree_component(ray.direction.x);
    rays.dir_y[lane] = embree_component(ray.direction.y);
    rays.dir_z[lane] = embree_component(ray.direction.z);
    rays.time[lane] = 0;
    rays.tfar[lane] = ray.t_far;
    rays.mask[lane] = ray.mask;
    rays.id[lane] = static_cast<unsigned>(lane);
    rays.flags[lane] = 0;
}

/// Gives idle lanes a ray that ends before it starts. On CPUs that trace fewer than sixteen rays at
/// a time, Embree 3 detects idle lanes only by that, not by the mask.
template <typename Ray16>
void idle_other_lanes(Ray16& rays, const PacketMask& taking_part)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!taking_part[i]) {
            set_lane(rays, i, {scene::Vec3f{0}, scene::Vec3f{1}, infinity, -infinity, 0});
        }
    }
}

/// Writes Embree's single ray.
template <typename Ray1>
void set_ray(Ray1& single, const FloatRay& ray)
{
    single.org_x = ray.origin.x;
    single.org_y = ray.origin.y;
    single.org_z = ray.origin.z;
    single.tnear = ray.t_near;
    single.dir_x = embree_component(ray.direction.x);
    single.dir_y = embree_component(ray.direction.y);
    single.dir_z = embree_component(ray.direction.z);
    single.time = 0;
    single.tfar = ray.t_far;
    single.mask = ray.mask;
    single.id = 0;
    single.flags = 0;
}

} // namespace gnomon::reference_rt
