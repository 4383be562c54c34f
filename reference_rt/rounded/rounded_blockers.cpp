#include "reference_rt/exact/crossing_depth.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/rounded/rounded_truth.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <limits>
#include <stdexcept>

namespace gnomon::reference_rt {

using renderers::BlockerHit;
using scene::no_triangle;
using scene::Vec3d;

namespace {

/// The points nearest to P on T, for up to sixteen pixels.
struct ProjectedPacket {
    ProjectedPacket(const scene::TriangleScene& triangles, const scene::RoundedReceivers& given,
                    const scene::RoundedTruth& truth, std::span<const std::size_t> pixels,
                    SignCounts& counts)
    {
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const std::uint32_t triangle = truth.triangle[pixels[i]];
            faces[i] = {triangles, triangle};
            const auto& [x, y, z] = faces[i].normal;
            const Vec3d normal{x.value, y.value, z.value};
            if (largest(normal) > 0) {
                rays[i] = CameraRay{{Vec3d{given.position[pixels[i]]}, normalised(normal)}};
                points[i] = Receiver{faces[i], rays[i], counts};
                if (points[i].delta_sign != 0) {
                    valid.add(i);
                }
            }
        }
    }
    ProjectedPacket(const ProjectedPacket&) = delete;
    ProjectedPacket& operator=(const ProjectedPacket&) = delete;

    PacketMask valid;
    PacketOf<ExactTriangle> faces;
    PacketOf<CameraRay> rays;
    PacketOf<Receiver> points;
};

BlockerHit hit_of(const scene::TriangleScene& triangles, const Receiver& point,
                  std::uint32_t blocker, const scene::Light& light)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const Vec3d towards =
        light.has_position() ? -exact_offset(point, light.position) : -light.direction;
    const double way = crossing_parameter(point, corners_of(triangles, blocker), light);
    return {blocker, way * glm::length(towards), unknown, unknown};
}

} // namespace

std::vector<BlockerHit> find_rounded_blockers(const ReferenceScene& reference,
                                              const scene::Light& light,
                                              const scene::RoundedReceivers& receivers,
                                              const scene::RoundedTruth& truth,
                                              std::span<const std::size_t> pixels, int threads)
{
    const auto& implementation = reference.implementation();
    if (!implementation.padded || receivers.position.size() != truth.triangle.size()) {
        throw std::invalid_argument{"find_rounded_blockers: the reference must serve exact truth, "
                                    "and the truth be of the receivers' size"};
    }
    const auto triangle_count = implementation.triangles.triangles.size();
    for (const std::size_t pixel : pixels) {
        if (pixel >= truth.triangle.pixel_count() || truth.triangle[pixel] >= triangle_count) {
            throw std::invalid_argument{
                fmt::format("find_rounded_blockers: pixel {} has no receiver", pixel)};
        }
    }
    const SegmentLight segments{implementation, light};
    std::vector<BlockerHit> blockers(pixels.size());
    for_each_packet(pixels.size(), threads, [&](std::size_t first, std::size_t count) {
        SignCounts counts;
        const ProjectedPacket packet{implementation.triangles, receivers, truth,
                                     pixels.subspan(first, count), counts};
        if (!packet.valid.any()) {
            return;
        }
        const auto contacts = trace_segments(implementation, segments, packet.valid, packet.points,
                                             SegmentGoal::nearest_blocker, counts);
        for (std::size_t i = 0; i < count; ++i) {
            if (contacts[i].witness != no_triangle) {
                blockers[first + i] =
                    hit_of(implementation.triangles, packet.points[i], contacts[i].witness, light);
            }
        }
    });
    implementation.errors.check("find_rounded_blockers");
    return blockers;
}

} // namespace gnomon::reference_rt
