#include "reference_rt/classify.hpp"
#include "reference_rt/first_hit.hpp"
#include "reference_rt/shadow_segments.hpp"
#include "reference_rt/tiles.hpp"

#include <tbb/combinable.h>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::Image;
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
          source_{reference.triangles, view, receivers},
          first_hits_{reference, view, raster},
          light_{reference, view.light},
          layers_{empty_layers(view.image)}
    {
    }

    /// Classifies the pixels of one tile; different tiles may run at the same time.
    void classify_tile(int column, int row)
    {
        Worker& worker = workers_.local();
        const Tile& tile = worker.tile;
        source_.fill(worker.tile, column, row, worker.counts);
        const PacketMask matched = first_hits_.match(tile, worker.counts);
        find_light_sides(worker);
        PacketMask open; // lanes that the shadow rays decide
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (tile.valid[i] && !matched[i]) {
                const auto [pixel_class, reason] =
                    first_hits_.explain(tile.rays[i], tile.x[i], tile.y[i],
                                        receivers_(tile.x[i], tile.y[i]), worker.counts);
                write(tile, i, pixel_class, reason);
            } else if (tile.seen[i] && may_be_lit(worker, i)) {
                open.add(i);
            }
        }
        if (open.any()) {
            cast_shadow_rays(tile, open, worker.counts);
        }
    }

    [[nodiscard]] TruthLayers take()
    {
        workers_.combine_each([&](const Worker& worker) {
            layers_.signs.filtered += worker.counts.filtered;
            layers_.signs.exact += worker.counts.exact;
        });
        return std::move(layers_);
    }

private:
    /// What a thread keeps from tile to tile.
    struct Worker {
        Tile tile;
        PacketOf<Sign> light_side{}; ///< of each facet
        SignCounts counts;
    };

    void find_light_sides(Worker& worker) const
    {
        for (std::size_t f = 0; f < worker.tile.facet_count; ++f) {
            worker.light_side[f] =
                light_side(worker.tile.facets[f].corners, view_.light, worker.counts);
        }
    }

    /// False when the light cannot reach the side that is seen; its class is written.
    [[nodiscard]] bool may_be_lit(Worker& worker, std::size_t i)
    {
        const Tile& tile = worker.tile;
        if (is_attached(tile.receivers[i], worker.light_side[tile.facet_of[i]])) {
            write(tile, i, PixelClass::attached, ClassReason::none);
            return false;
        }
        if (is_out_of_light(tile.receivers[i], view_.light, worker.counts)) {
            write(tile, i, PixelClass::out_of_light, ClassReason::none);
            return false;
        }
        return true;
    }

    void cast_shadow_rays(const Tile& tile, const PacketMask& open, SignCounts& counts)
    {
        const auto contacts = trace_segments(reference_, light_, open, tile.receivers,
                                             SegmentGoal::any_blocker, counts);
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
    TileSource source_;
    FirstHits first_hits_;
    SegmentLight light_;
    TruthLayers layers_;
    tbb::combinable<Worker> workers_;
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
