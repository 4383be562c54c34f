#pragma once

#include "reference_rt/injected_faults.hpp"
#include "reference_rt/pixels/corner_fans.hpp"
#include "reference_rt/reference_scene.hpp"
#include "reference_rt/traversal/embree.hpp"
#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "reference_rt/traversal/unit_frame.hpp"

#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

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

/// Judges the candidates of one query: the triangles whose padded boxes its rays hit. Exceptions
/// wait until Embree is left.
class CandidateTest {
public:
    CandidateTest() = default;
    CandidateTest(const CandidateTest&) = delete;
    CandidateTest& operator=(const CandidateTest&) = delete;
    virtual ~CandidateTest() = default;

    /// For a packet: those of the asking lanes that need no further candidates.
    [[nodiscard]] virtual LaneBits judge_packet(std::uint32_t triangle, LaneBits asking) = 0;
    /// For a search that narrows: lowers the asking lanes' distances beyond which no candidate
    /// matters any more. A single ray is lane 0.
    virtual void judge_distances(std::uint32_t triangle, LaneBits asking,
                                 PacketOf<float>& t_far) = 0;

    std::exception_ptr failure;
};

/// The triangles, their hierarchies in Embree, and the way back from Embree's numbers.
///
/// One geometry for each pair of roles that occurs, numbered alike in both hierarchies.
struct ReferenceScene::Implementation {
    Implementation(const scene::TriangleScene& scene, const ReferenceOptions& options,
                   const Faults& faults_in = {});

    /// The scene's index of Embree's primitive.
    [[nodiscard]] std::uint32_t triangle(unsigned geometry, unsigned primitive) const
    {
        return roles[geometry].members[primitive];
    }

    /// Shows the judge every triangle of a role in `mask` that the segments behind `rays` may touch
    /// (in the unit frame; see `box_padding`).
    void find_candidates(LaneBits lanes, const FloatRays& rays, RayMask mask,
                         CandidateTest& judge) const;
    /// As above, from near to far as a rule, and only up to the judge's distances. Each lane's id
    /// must be its index; idle lanes are overwritten.
    void find_candidates(const PacketMask& valid, RTCRayHit16& rays, CandidateTest& judge) const;
    void find_candidates(RTCRayHit& ray, CandidateTest& judge) const;

    /// The valid lanes whose float rays meet a native triangle.
    /// @param own  Receivers by lane, whose own triangles do not count; nullptr: all count.
    [[nodiscard]] PacketMask find_occluded(const PacketMask& valid, RTCRay16& rays,
                                           const PacketOf<Receiver>* own) const;

    /// The triangles around each corner; made when first asked for.
    [[nodiscard]] const CornerFans& corner_fans() const;

    /// The triangles of one pair of roles.
    struct Role {
        const Implementation* owner;
        unsigned mask;
        std::vector<std::uint32_t> members; ///< [primitive]
    };

    Faults faults;
    scene::TriangleScene triangles; ///< Embree reads its vertices in place
    scene::Box bounds;
    UnitFrame frame;
    double padding;          ///< of boxes on each side, in the unit frame
    std::vector<Role> roles; ///< [geometry]
    EmbreeErrors errors;
    embree::Device device; ///< after `errors`, which it reports to until it dies
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
