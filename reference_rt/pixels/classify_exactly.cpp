#include "reference_rt/pixels/classify.hpp"
#include "reference_rt/pixels/first_hit.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/pixels/tiles.hpp"

#include <tbb/combinable.h>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::Image;
using scene::LightType;
using scene::PixelClass;
using scene::Truth;
using scene::View;

namespace {

/// The state shared by all tiles of an image.
class ExactRun {
public:
    ExactRun(const ReferenceScene::Implementation& reference, const View& view,
             const Image<std::uint32_t>& receivers, const renderers::RasterFacts& raster)
        : reference_{reference},
          view_{view},
          source_{reference.triangles, view, receivers},
          first_hits_{reference, view, raster},
          light_{reference, view.light},
          layers_{empty_layers(view.image)}
    {
    }

    /// Classifies the pixels of one tile. Tiles may run in parallel.
    void classify_tile(int column, int row)
    {
        Worker& worker = workers_.local();
        const Tile& tile = worker.tile;
        source_.fill(worker.tile, column, row, worker.counts);
        if (tile.seen != 0) {
            find_unit_points(tile.rays, tile.hits, reference_.frame, worker.starts.points);
        }
        const LaneBits matched = first_hits_.match(tile, worker.starts.points, worker.counts);
        explain(worker, tile.valid & ~matched);
        const LaneBits surface = tile.seen & matched;
        const LaneBits attached = surface & find_attached(worker);
        write(tile, attached, PixelClass::attached);
        const LaneBits out = find_out_of_light(worker, surface & ~attached);
        write(tile, out, PixelClass::out_of_light);
        worker.starts.lanes = surface & ~attached & ~out;
        if (worker.starts.lanes != 0) {
            cast_shadow_rays(worker);
        }
    }

    [[nodiscard]] Truth take()
    {
        workers_.combine_each([&](const Worker& worker) {
            layers_.signs.filtered += worker.counts.filtered;
            layers_.signs.exact += worker.counts.exact;
        });
        return std::move(layers_);
    }

private:
    /// Per-thread state, reused between tiles.
    struct Worker {
        Worker()
        {
            starts.receiver = [this](std::size_t lane) -> const Receiver& {
                return tile.receiver(lane);
            };
        }
        Worker(const Worker&) = delete;
        Worker& operator=(const Worker&) = delete;

        Tile tile;
        SegmentStarts starts;
        SignCounts counts;
    };

    /// Explains the lanes in which GL's triangle is not a first hit.
    void explain(Worker& worker, LaneBits unmatched)
    {
        const Tile& tile = worker.tile;
        for (; unmatched != 0; unmatched &= unmatched - 1) {
            const std::size_t lane = first_lane(unmatched);
            const auto [pixel_class, reason] =
                first_hits_.explain(tile.rays.ray(lane), tile.x(lane), tile.y(lane),
                                    tile.triangles[lane], worker.counts);
            write(tile, lane, pixel_class, reason);
        }
    }

    /// The lanes in which the light is not on the visible side.
    [[nodiscard]] LaneBits find_attached(Worker& worker) const
    {
        const Tile& tile = worker.tile;
        LaneBits attached = 0;
        for (std::size_t f = 0; f < tile.face_count; ++f) {
            const Sign side = light_side(tile.faces[f], view_.light, worker.counts);
            attached |= tile.face_lanes[f] & are_attached(tile.hits, side);
        }
        return attached;
    }

    [[nodiscard]] LaneBits find_out_of_light(Worker& worker, LaneBits lanes) const
    {
        LaneBits out = 0;
        if (!view_.light.has_cone()) {
            return out;
        }
        for (; lanes != 0; lanes &= lanes - 1) {
            const std::size_t lane = first_lane(lanes);
            if (is_out_of_light(worker.tile.receiver(lane), view_.light, worker.counts)) {
                out |= LaneBits{1} << lane;
            }
        }
        return out;
    }

    void cast_shadow_rays(Worker& worker)
    {
        const Tile& tile = worker.tile;
        SegmentStarts& starts = worker.starts;
        starts.triangles = tile.triangles;
        const auto contacts =
            trace_segments(reference_, light_, starts, SegmentGoal::any_blocker, worker.counts);
        for (LaneBits rest = starts.lanes; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            const Shadowing shadowing = classify_segment(contacts[lane]);
            write(tile, lane, shadowing.pixel_class, shadowing.reason);
            layers_.witness(tile.x(lane), tile.y(lane)) = contacts[lane].witness;
        }
    }

    void write(const Tile& tile, LaneBits lanes, PixelClass pixel_class)
    {
        for (; lanes != 0; lanes &= lanes - 1) {
            const std::size_t lane = first_lane(lanes);
            layers_.pixel_class(tile.x(lane), tile.y(lane)) = pixel_class;
        }
    }

    void write(const Tile& tile, std::size_t lane, PixelClass pixel_class, ClassReason reason)
    {
        layers_.pixel_class(tile.x(lane), tile.y(lane)) = pixel_class;
        layers_.reason(tile.x(lane), tile.y(lane)) = reason;
    }

    const ReferenceScene::Implementation& reference_;
    const View& view_;
    TileSource source_;
    FirstHits first_hits_;
    SegmentLight light_;
    Truth layers_;
    tbb::combinable<Worker> workers_;
};

} // namespace

Truth classify_exactly(const ReferenceScene::Implementation& reference, const View& view,
                       const Image<std::uint32_t>& receivers, const renderers::RasterFacts& raster,
                       int threads)
{
    ExactRun run{reference, view, receivers, raster};
    for_each_tile(view.image, threads,
                  [&](int column, int row) { run.classify_tile(column, row); });
    return run.take();
}

} // namespace gnomon::reference_rt
