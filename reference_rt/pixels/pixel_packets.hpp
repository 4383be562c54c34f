#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/tiles.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "scene/image.hpp"
#include "scene/view/view.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt {

/// The pixels of a view, with GL's triangle in each. All references must outlive this object.
struct SeenPixels {
    SeenPixels(const scene::TriangleScene& triangles_in, const scene::View& view_in,
               const scene::Image<std::uint32_t>& receivers_in);

    const scene::TriangleScene& triangles;
    const scene::View& view;
    const scene::Image<std::uint32_t>& receivers;
    std::vector<double> sx; ///< of each column
    std::vector<double> sy; ///< of each row

    [[nodiscard]] CameraRay ray_of(std::size_t pixel) const
    {
        return CameraRay{pixel_ray(view.camera, sx[pixel % sx.size()], sy[pixel / sx.size()])};
    }
    [[nodiscard]] ExactTriangle face_of(std::size_t pixel) const
    {
        return {triangles, receivers[pixel]};
    }
    /// @throws std::invalid_argument  if a pixel has no receiver in the scene; names `caller`.
    void check(std::span<const std::size_t> pixels, const char* caller) const;
};

/// The receivers of up to sixteen arbitrary pixels. Must not move, as receivers refer to rays and
/// triangles.
struct PixelPacket {
    PixelPacket(const SeenPixels& seen, std::span<const std::size_t> pixels, SignCounts& counts)
    {
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            faces[i] = seen.face_of(pixels[i]);
            rays[i] = seen.ray_of(pixels[i]);
            receivers[i] = Receiver{faces[i], rays[i], counts};
            if (receivers[i].delta_sign != 0) {
                valid.add(i);
            }
        }
    }
    PixelPacket(const PixelPacket&) = delete;
    PixelPacket& operator=(const PixelPacket&) = delete;

    PacketMask valid; ///< lanes with a point P: not edge-on
    PacketOf<ExactTriangle> faces;
    PacketOf<CameraRay> rays;
    PacketOf<Receiver> receivers;
};

/// Calls `run(first, count)` in parallel for runs of at most sixteen of `total`.
template <typename Run>
void for_each_packet(std::size_t total, int threads, const Run& run)
{
    CallerFloatSettings same;
    with_threads(threads, [&] {
        tbb::parallel_for(
            std::size_t{0}, (total + packet_size - 1) / packet_size,
            [&](std::size_t packet) {
                const std::size_t first = packet * packet_size;
                run(first, std::min(packet_size, total - first));
            },
            tbb::auto_partitioner{}, same.context());
    });
}

} // namespace gnomon::reference_rt
