#include "reference_rt/pixels/classify.hpp"

#include "reference_rt/pixels/tiles.hpp"

#include <glm/geometric.hpp>
#include <tbb/combinable.h>

#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec3f;

namespace {

/// A position moved off its surface along the unit normal: 256 ulps per unit of the normal, 2^-16
/// near the origin. Source: C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding
/// Self-Intersection", Ray Tracing Gems (2019), chapter 6.
Vec3f offset_by_ulps(const Vec3f& position, const Vec3f& normal)
{
    constexpr float near_origin = 1.0F / 32;
    Vec3f moved;
    for (int i = 0; i < 3; ++i) {
        const auto steps = static_cast<std::int32_t>(256.0F * normal[i]);
        const auto bits = std::bit_cast<std::int32_t>(position[i]);
        moved[i] = std::abs(position[i]) < near_origin
                       ? position[i] + normal[i] / 65536.0F
                       : std::bit_cast<float>(bits + (position[i] < 0 ? -steps : steps));
    }
    return moved;
}

FloatRay plain_ray(const Receiver& receiver, const scene::Light& light, PlainOffset offset,
                   float t_near)
{
    const Vec3d point = receiver.point();
    const Vec3d to_light = light.way_from(point);
    const double length = glm::length(to_light);
    Vec3f origin{point};
    if (offset == PlainOffset::integer) {
        const Vec3d n = glm::normalize(glm::cross(receiver.corners()[1] - receiver.corners()[0],
                                                  receiver.corners()[2] - receiver.corners()[0]));
        origin = offset_by_ulps(origin, Vec3f{glm::dot(n, to_light) < 0 ? -n : n});
    }
    return {origin, Vec3f{to_light / length}, offset == PlainOffset::ray_start ? t_near : 0.0F,
            light.has_position() ? static_cast<float>(length)
                                 : std::numeric_limits<float>::infinity(),
            casters};
}

} // namespace

PacketMask trace_plain(const ReferenceScene::Implementation& reference, const scene::Light& light,
                       PlainOffset offset, const PacketMask& valid,
                       const PacketOf<Receiver>& receivers)
{
    const auto t_near = static_cast<float>(1e-4 * reference.bounds.diagonal_m());
    RTCRay16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (valid[i]) {
            set_lane(packet, i, plain_ray(receivers[i], light, offset, t_near));
        }
    }
    return reference.find_occluded(valid, packet,
                                   offset == PlainOffset::own_triangle ? &receivers : nullptr);
}

using scene::ClassReason;
using scene::Image;
using scene::PixelClass;
using scene::Truth;
using scene::View;

Truth classify_by_plain_rays(const ReferenceScene::Implementation& reference, const View& view,
                             const Image<std::uint32_t>& receivers, int threads)
{
    Truth layers = empty_layers(view.image);
    const TileSource source{reference.triangles, view, receivers};
    tbb::combinable<Tile> tiles;
    for_each_tile(view.image, threads, [&](int column, int row) {
        SignCounts ignored; // plain rays prove no signs
        Tile& tile = tiles.local();
        source.fill(tile, column, row, ignored);
        PacketMask open;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if ((tile.seen >> i & 1U) == 0) {
                continue;
            }
            const Receiver& receiver = tile.receiver(i);
            PixelClass& pixel_class = layers.pixel_class(tile.x(i), tile.y(i));
            if (receiver.delta_sign == 0) { // edge-on: no point P
                pixel_class = PixelClass::unmatched;
                layers.reason(tile.x(i), tile.y(i)) = ClassReason::snap;
            } else if (is_attached(receiver, light_side(receiver.corners(), view.light, ignored))) {
                pixel_class = PixelClass::attached;
            } else if (is_out_of_light(receiver, view.light, ignored)) {
                pixel_class = PixelClass::out_of_light;
            } else {
                open.add(i);
            }
        }
        if (!open.any()) {
            return;
        }
        const PacketMask blocked =
            trace_plain(reference, view.light, PlainOffset::ray_start, open, tile.receivers());
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (open[i]) {
                layers.pixel_class(tile.x(i), tile.y(i)) =
                    blocked[i] ? PixelClass::blocked : PixelClass::lit;
            }
        }
    });
    return layers;
}

} // namespace gnomon::reference_rt
