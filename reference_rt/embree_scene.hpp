#pragma once

#include "reference_rt/embree.hpp"
#include "reference_rt/truth.hpp"

#include <array>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

/// What a ray asks for; the bits of the ray and geometry masks.
enum RayMask : unsigned {
    casters = 1U << 0,   ///< shadow rays
    receivers = 1U << 1, ///< camera rays
};

/// Collects what Embree reports, as its callback must not throw.
class EmbreeErrors {
public:
    /// For `rtcSetDeviceErrorFunction`; `self` is an `EmbreeErrors`. Keeps the first error.
    static void record(void* self, RTCError code, const char* message) noexcept;
    /// @throws scene::EnvironmentError  if an error was reported since the scene was made.
    void check(const char* during) const;

private:
    mutable std::mutex mutex_;
    RTCError code_ = RTC_ERROR_NONE;
    std::string message_;
};

/// The triangles, their Embree scene, and the way back from Embree's numbers.
struct ReferenceScene::Implementation {
    Implementation(const scene::TriangleScene& scene, int threads);

    /// The scene's index of Embree's primitive.
    [[nodiscard]] std::uint32_t triangle(unsigned geometry, unsigned primitive) const
    {
        return triangle_of[geometry][primitive];
    }

    scene::TriangleScene triangles; ///< Embree reads its vertices in place
    scene::Box bounds;
    double largest_coordinate_m = 0;
    EmbreeErrors errors;
    embree::Device device; ///< after `errors`, which it reports to until it dies
    embree::Scene scene;
    /// [geometry][primitive]; one geometry for each pair of roles that occurs.
    std::vector<std::vector<std::uint32_t>> triangle_of;

private:
    void add_geometry(unsigned mask, std::vector<std::uint32_t> members);
};

} // namespace gnomon::reference_rt
