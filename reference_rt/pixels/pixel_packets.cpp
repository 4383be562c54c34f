#include "reference_rt/pixels/pixel_packets.hpp"

#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/truth.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace gnomon::reference_rt {

using scene::Image;
using scene::no_triangle;

SeenPixels::SeenPixels(const scene::TriangleScene& triangles_in, const scene::View& view_in,
                       const Image<std::uint32_t>& receivers_in)
    : triangles{triangles_in},
      view{view_in},
      receivers{receivers_in}
{
    for (int x = 0; x < view.image.width_px; ++x) {
        sx.push_back(pixel_sx(view.camera, view.image, x));
    }
    for (int y = 0; y < view.image.height_px; ++y) {
        sy.push_back(pixel_sy(view.camera, view.image, y));
    }
}

void SeenPixels::check(std::span<const std::size_t> pixels, const char* caller) const
{
    for (const std::size_t pixel : pixels) {
        if (pixel >= receivers.pixel_count() || receivers[pixel] >= triangles.triangles.size()) {
            throw std::invalid_argument{
                fmt::format("{}: pixel {} has no receiver in the scene", caller, pixel)};
        }
    }
}

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
    const SeenPixels seen{implementation.triangles, view, receivers};
    seen.check(pixels, "nearest_blockers");
    const SegmentLight light{implementation, view.light};
    std::vector<std::uint32_t> blockers(pixels.size(), no_triangle);
    for_each_packet(pixels.size(), threads, [&](std::size_t first, std::size_t count) {
        SignCounts counts;
        const PixelPacket packet{seen, pixels.subspan(first, count), counts};
        if (!packet.valid.any()) {
            return;
        }
        const auto contacts = trace_segments(implementation, light, packet.valid, packet.receivers,
                                             SegmentGoal::nearest_blocker, counts);
        for (std::size_t i = 0; i < count; ++i) {
            blockers[first + i] = contacts[i].witness;
        }
    });
    implementation.errors.check("nearest_blockers");
    return blockers;
}

} // namespace gnomon::reference_rt
