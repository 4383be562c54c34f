#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/pixels/corner_fans.hpp"
#include "reference_rt/reference_scene.hpp"
#include "reference_rt/traversal/embree.hpp"
#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

/// Faults that tests inject into the truth to check the checkers; none by default.
struct Faults {
    Sign light_sign = 1;      ///< −1 flips the filtered sign of the light's side of a triangle
    double padding_share = 1; ///< 0 removes the padding of Embree's boxes
    std::uint32_t hidden_triangle = scene::no_triangle; ///< Embree never hits this triangle
};

/// Stores Embree's error, as its callback must not throw.
class EmbreeErrors {
public:
    /// Callback for `rtcSetDeviceErrorFunction`; `self` is an `EmbreeErrors`. Keeps the first
    /// error.
    static void record(void* self, RTCError code, const char* message) noexcept;
    /// @throws scene::EnvironmentError  if an error was reported since the scene was made.
    void check(const char* during) const;

private:
    mutable std::mutex mutex_;
    RTCError code_ = RTC_ERROR_NONE;
    std::string message_;
};

/// Tests the candidates of a query, triangles whose padded boxes its rays hit. Exceptions are
/// rethrown after Embree returns.
class CandidateTest {
public:
    CandidateTest() = default;
    CandidateTest(const CandidateTest&) = delete;
    CandidateTest& operator=(const CandidateTest&) = delete;
    virtual ~CandidateTest() = default;

    /// For a packet: returns the active lanes that need no further candidates.
    [[nodiscard]] virtual LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) = 0;
    /// For a narrowing search: lowers the active lanes' maximum distances. A single ray is lane 0.
    virtual void judge_distances(std::uint32_t triangle, LaneBits asking,
                                 PacketOf<float>& t_far) = 0;

    std::exception_ptr failure;
};

/// The triangles, their Embree hierarchies, and the mapping from Embree's primitives.
///
/// There is one geometry for each combination of roles, with equal numbers in both hierarchies.
struct ReferenceScene::Implementation {
    Implementation(const scene::TriangleScene& scene, const ReferenceOptions& options,
                   const Faults& faults_in = {});

    /// The scene's triangle index of an Embree primitive.
    [[nodiscard]] std::uint32_t triangle(unsigned geometry, unsigned primitive) const
    {
        return roles[geometry].members[primitive];
    }

    /// Passes `judge` every triangle with a role in `mask` that the exact segments of `rays` may
    /// touch (in the unit frame; see `box_padding`).
    void find_candidates(LaneBits lanes, const FloatRays& rays, RayMask mask,
                         CandidateTest& judge) const;
    /// As above, roughly from near to far, and only up to the judge's distances. Each lane's id
    /// must be its index; idle lanes are overwritten.
    void find_candidates(const PacketMask& valid, RTCRayHit16& rays, CandidateTest& judge) const;
    void find_candidates(RTCRayHit& ray, CandidateTest& judge) const;

    /// The valid lanes whose float rays hit a native triangle.
    /// @param own  receivers by lane, whose own triangles are ignored; null to ignore none.
    [[nodiscard]] PacketMask find_occluded(const PacketMask& valid, RTCRay16& rays,
                                           const PacketOf<Receiver>* own) const;

    /// The triangles around each corner; built on first use.
    [[nodiscard]] const CornerFans& corner_fans() const;

    /// The triangles with one combination of roles.
    struct Role {
        const Implementation* owner;
        unsigned mask;
        std::vector<std::uint32_t> members; ///< [primitive]
    };

    Faults faults;
    scene::TriangleScene triangles; ///< Embree reads the vertices in place
    scene::Box bounds;
    UnitFrame frame;
    double padding;          ///< of the boxes on each side, in the unit frame
    std::vector<Role> roles; ///< [geometry]
    EmbreeErrors errors;
    embree::Device device; ///< after `errors`, to which it reports until destroyed
    embree::Scene native;  ///< float32 triangles in world space, or null
    embree::Scene padded;  ///< padded boxes in the unit frame, or null

private:
    [[nodiscard]] embree::Scene build(void (Implementation::*fill)(RTCGeometry, const Role&),
                                      RTCGeometryType type);
    void fill_native(RTCGeometry geometry, const Role& role);
    void fill_padded(RTCGeometry geometry, const Role& role);

    mutable std::once_flag corner_fans_made_;
    mutable std::unique_ptr<const CornerFans> corner_fans_;
};

} // namespace gnomon::reference_rt
