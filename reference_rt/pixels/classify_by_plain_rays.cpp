#include "reference_rt/pixels/classify.hpp"
#include "reference_rt/pixels/plain_shadow.hpp"
#include "reference_rt/pixels/tiles.hpp"

#include <tbb/combinable.h>

namespace gnomon::reference_rt {

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
        SignCounts ignored; // of a method that proves nothing
        Tile& tile = tiles.local();
        source.fill(tile, column, row, ignored);
        PacketMask open;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if ((tile.seen >> i & 1U) == 0) {
                continue;
            }
            const Receiver& receiver = tile.receiver(i);
            PixelClass& pixel_class = layers.pixel_class(tile.x(i), tile.y(i));
            if (receiver.delta_sign == 0) { // edge-on: there is no point P
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
