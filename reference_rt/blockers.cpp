#include "reference_rt/shadow_segments.hpp"
#include "reference_rt/tiles.hpp"
#include "reference_rt/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::reference_rt {

using scene::Image;
using scene::no_triangle;

namespace {

struct Search {
    const ReferenceScene::Implementation& reference;
    const scene::View& view;
    const Image<std::uint32_t>& receivers;
    SegmentLight light;

    [[nodiscard]] CameraRay ray_of(std::size_t pixel) const
    {
        const auto width = static_cast<std::size_t>(view.image.width_px);
        return CameraRay{pixel_ray(view.camera, view.image, static_cast<int>(pixel % width),
                                   static_cast<int>(pixel / width))};
    }

    /// Finds the blockers of at most a packet of pixels.
    void find(std::span<const std::size_t> pixels, std::span<std::uint32_t> blockers) const
    {
        SignCounts counts;
        PacketMask valid;
        PacketOf<Facet> facets;
        PacketOf<CameraRay> rays;
        PacketOf<Receiver> packet;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const std::uint32_t triangle = receivers[pixels[i]];
            facets[i] = Facet{triangle, corners_of(reference.triangles, triangle)};
            rays[i] = ray_of(pixels[i]);
            packet[i] = Receiver{facets[i], rays[i], counts};
            if (packet[i].delta_sign != 0) { // else edge-on: there is no point P
                valid.add(i);
            }
        }
        if (!valid.any()) {
            return;
        }
        const auto contacts =
            trace_segments(reference, light, valid, packet, SegmentGoal::nearest_blocker, counts);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            blockers[i] = contacts[i].witness;
        }
    }
};

void check_pixels(const Image<std::uint32_t>& receivers, std::span<const std::size_t> pixels,
                  std::size_t triangle_count)
{
    for (const std::size_t pixel : pixels) {
        if (pixel >= receivers.pixel_count() || receivers[pixel] >= triangle_count) {
            throw std::invalid_argument{
                fmt::format("nearest_blockers: pixel {} has no receiver in the scene", pixel)};
        }
    }
}

} // namespace

std::vector<std::uint32_t> nearest_blockers(const ReferenceScene& reference,
                                            const scene::View& view,
                                            const Image<std::uint32_t>& receivers,
                                            std::span<const std::size_t> pixels, int threads)
{
    const auto& implementation = reference.implementation();
    if (!implementation.padded || receivers.size() != view.image) {
        throw std::invalid_argument{"nearest_blockers: the reference must serve exact truth, and "
                                    "receivers be of the image's size"};
    }
    check_pixels(receivers, pixels, implementation.triangles.triangles.size());
    const Search search{implementation, view, receivers, {implementation, view.light}};
    std::vector<std::uint32_t> blockers(pixels.size(), no_triangle);
    const std::size_t packets = (pixels.size() + packet_size - 1) / packet_size;
    with_threads(threads, [&] {
        tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t packet) {
            const std::size_t first = packet * packet_size;
            const std::size_t count = std::min(packet_size, pixels.size() - first);
            search.find(pixels.subspan(first, count), std::span{blockers}.subspan(first, count));
        });
    });
    implementation.errors.check("nearest_blockers");
    return blockers;
}

} // namespace gnomon::reference_rt
