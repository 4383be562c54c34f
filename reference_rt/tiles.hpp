#pragma once

#include "reference_rt/packet.hpp"
#include "reference_rt/predicates.hpp"
#include "scene/image.hpp"
#include "scene/job.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace gnomon::reference_rt {

/// 4×4 pixels and their rays; lanes beyond the image's border are not valid.
struct Tile {
    PacketMask valid;
    PacketOf<int> x{};
    PacketOf<int> y{};
    PacketOf<CameraRay> rays;
};

[[nodiscard]] inline Tile gather_tile(const scene::View& view, int column, int row)
{
    Tile tile;
    for (std::size_t i = 0; i < packet_size; ++i) {
        tile.x[i] = column * tile_side_px + static_cast<int>(i) % tile_side_px;
        tile.y[i] = row * tile_side_px + static_cast<int>(i) / tile_side_px;
        if (tile.x[i] < view.image.width_px && tile.y[i] < view.image.height_px) {
            tile.valid.add(i);
            tile.rays[i] = CameraRay{pixel_ray(view.camera, view.image, tile.x[i], tile.y[i])};
        }
    }
    return tile;
}

/// Runs `job` with that many threads; 0 means all cores.
template <typename Job>
void with_threads(int threads, const Job& job)
{
    if (threads <= 0) {
        job();
        return;
    }
    const tbb::global_control limit{tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads)};
    tbb::task_arena arena{threads};
    arena.execute(job);
}

/// Calls `run(column, row)` for every tile of the image, several at the same time.
template <typename Run>
void for_each_tile(scene::ImageSize image, int threads, const Run& run)
{
    const int columns = (image.width_px + tile_side_px - 1) / tile_side_px;
    const int rows = (image.height_px + tile_side_px - 1) / tile_side_px;
    with_threads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<int>{0, rows},
                          [&](const tbb::blocked_range<int>& range) {
                              for (int row = range.begin(); row != range.end(); ++row) {
                                  for (int column = 0; column < columns; ++column) {
                                      run(column, row);
                                  }
                              }
                          });
    });
}

} // namespace gnomon::reference_rt
