#include "reference_rt/classify.hpp"
#include "reference_rt/first_hit.hpp"
#include "reference_rt/shadow_segments.hpp"
#include "reference_rt/tiles.hpp"

#include <tbb/combinable.h>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::Image;
using scene::no_triangle;
using scene::PixelClass;
using scene::TruthLayers;
using scene::View;

namespace {

/// Everything that is the same for all tiles of one image.
class ExactRun {
public:
    ExactRun(const ReferenceScene::Implementation& reference, const View& view,
             const Image<std::uint32_t>& receivers, const RasterFacts& raster)
        : reference_{reference},
          view_{view},
          receivers_{receivers},
          first_hits_{reference, view, raster},
          light_{reference, view.light},
          layers_{empty_layers(view.image)}
    {
    }

    /// Classifies the pixels of one tile; different tiles may run at the same time.
    void classify_tile(int column, int row)
    {
        SignCounts& counts = counts_.local();
        const Tile tile = gather_tile(view_, column, row);
        const auto receivers = make_receivers(tile, counts);
        const PacketMask matched = first_hits_.match(tile.valid, tile.rays, receivers, counts);
        PacketMask open; // lanes that the shadow rays decide
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (!tile.valid[i]) {
                continue;
            }
            if (!matched[i]) {
                const auto [pixel_class, reason] = first_hits_.explain(
                    tile.rays[i], tile.x[i], tile.y[i], receivers[i].triangle, counts);
                write(tile, i, pixel_class, reason);
            } else if (receivers[i].triangle != no_triangle &&
                       may_be_lit(tile, i, receivers[i], counts)) {
                open.add(i);
            }
        }
        if (open.any()) {
            cast_shadow_rays(tile, open, receivers, counts);
        }
    }

    [[nodiscard]] TruthLayers take()
    {
        const SignCounts counts =
            counts_.combine([](SignCounts a, const SignCounts& b) { return a += b; });
        layers_.signs = {counts.filtered, counts.exact};
        return std::move(layers_);
    }

private:
    [[nodiscard]] PacketOf<Receiver> make_receivers(const Tile& tile, SignCounts& counts) const
    {
        PacketOf<Receiver> receivers;
        Facet facet; // neighbouring pixels often show the same triangle
        for (std::size_t i = 0; i < packet_size; ++i) {
            const std::uint32_t triangle =
                tile.valid[i] ? receivers_(tile.x[i], tile.y[i]) : no_triangle;
            if (triangle == no_triangle) {
                continue;
            }
            if (facet.triangle != triangle) {
                facet = Facet{triangle, corners_of(reference_.triangles, triangle)};
            }
            receivers[i] = Receiver{facet, tile.rays[i], counts};
        }
        return receivers;
    }

    /// False when the light cannot reach the side that is seen; its class is written.
    [[nodiscard]] bool may_be_lit(const Tile& tile, std::size_t i, const Receiver& receiver,
                                  SignCounts& counts)
    {
        if (is_attached(receiver, view_.light, counts)) {
            write(tile, i, PixelClass::attached, ClassReason::none);
            return false;
        }
        if (is_out_of_light(receiver, view_.light, counts)) {
            write(tile, i, PixelClass::out_of_light, ClassReason::none);
            return false;
        }
        return true;
    }

    void cast_shadow_rays(const Tile& tile, const PacketMask& open,
                          const PacketOf<Receiver>& receivers, SignCounts& counts)
    {
        const auto contacts =
            trace_segments(reference_, light_, open, receivers, SegmentGoal::any_blocker, counts);
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (open[i]) {
                const Shadowing shadowing = classify_segment(contacts[i]);
                write(tile, i, shadowing.pixel_class, shadowing.reason);
                layers_.witness(tile.x[i], tile.y[i]) = contacts[i].witness;
            }
        }
    }

    void write(const Tile& tile, std::size_t i, PixelClass pixel_class, ClassReason reason)
    {
        layers_.pixel_class(tile.x[i], tile.y[i]) = pixel_class;
        layers_.reason(tile.x[i], tile.y[i]) = reason;
    }

    const ReferenceScene::Implementation& reference_;
    const View& view_;
    const Image<std::uint32_t>& receivers_;
    FirstHits first_hits_;
    SegmentLight light_;
    TruthLayers layers_;
    tbb::combinable<SignCounts> counts_;
};

} // namespace

TruthLayers classify_exactly(const ReferenceScene::Implementation& reference, const View& view,
                             const Image<std::uint32_t>& receivers, const RasterFacts& raster,
                             int threads)
{
    ExactRun run{reference, view, receivers, raster};
    for_each_tile(view.image, threads,
                  [&](int column, int row) { run.classify_tile(column, row); });
    return run.take();
}

} // namespace gnomon::reference_rt
