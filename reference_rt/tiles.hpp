#pragma once

#include "reference_rt/embree_scene.hpp"
#include "reference_rt/packet.hpp"
#include "reference_rt/predicates.hpp"
#include "scene/image.hpp"
#include "scene/job.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>

namespace gnomon::reference_rt {

/// 4×4 pixels, what GL saw in them, and where their rays meet that. A worker keeps one and fills it
/// again for each tile.
struct Tile {
    PacketMask valid; ///< lanes within the image's border
    PacketMask seen;  ///< lanes in which GL saw a triangle
    PacketOf<int> x{};
    PacketOf<int> y{};
    PacketOf<CameraRay> rays;
    PacketOf<Receiver> receivers; ///< of the lanes in `seen`
    PacketOf<std::size_t> facet_of{};
    PacketOf<Facet> facets;
    PacketOf<Filtered<8>> nu; ///< of each facet, for the ray that saw it first
    std::size_t facet_count = 0;
};

/// Fills tiles with what GL saw in them.
class TileSource {
public:
    /// @param receivers  GL's triangle per pixel. All arguments must outlive the source.
    TileSource(const scene::TriangleScene& triangles, const scene::View& view,
               const scene::Image<std::uint32_t>& receivers)
        : triangles_{triangles},
          view_{view},
          receivers_{receivers},
          has_eye_{view.camera.projection == scene::Projection::perspective}
    {
    }

    void fill(Tile& tile, int column, int row, SignCounts& counts) const
    {
        tile.valid = {};
        tile.seen = {};
        tile.facet_count = 0;
        std::array<double, tile_side_px> sx{};
        std::array<double, tile_side_px> sy{};
        for (int i = 0; i < tile_side_px; ++i) {
            const auto lane = static_cast<std::size_t>(i);
            sx[lane] = pixel_sx(view_.camera, view_.image, column * tile_side_px + i);
            sy[lane] = pixel_sy(view_.camera, view_.image, row * tile_side_px + i);
        }
        for (std::size_t i = 0; i < packet_size; ++i) {
            const int x = column * tile_side_px + static_cast<int>(i) % tile_side_px;
            const int y = row * tile_side_px + static_cast<int>(i) / tile_side_px;
            if (x < view_.image.width_px && y < view_.image.height_px) {
                tile.valid.add(i);
                tile.x[i] = x;
                tile.y[i] = y;
                std::construct_at(&tile.rays[i], pixel_ray(view_.camera, sx[i % tile_side_px],
                                                           sy[i / tile_side_px]));
                see(tile, i, receivers_(x, y), counts);
            }
        }
    }

private:
    void see(Tile& tile, std::size_t i, std::uint32_t triangle, SignCounts& counts) const
    {
        if (triangle == scene::no_triangle) {
            return;
        }
        tile.seen.add(i);
        // Neighbouring pixels often show the same triangle.
        if (tile.facet_count == 0 || tile.facets[tile.facet_count - 1].triangle != triangle) {
            tile.facets[tile.facet_count] = Facet{triangle, corners_of(triangles_, triangle)};
            tile.nu[tile.facet_count] =
                nu_of(tile.facets[tile.facet_count], tile.rays[i].ray.origin);
            ++tile.facet_count;
        }
        const std::size_t last = tile.facet_count - 1;
        tile.facet_of[i] = last;
        const Facet& facet = tile.facets[last];
        const Filtered<8> nu = has_eye_ ? tile.nu[last] : nu_of(facet, tile.rays[i].ray.origin);
        std::construct_at(&tile.receivers[i], facet, tile.rays[i], nu, counts); // no copy
    }

    const scene::TriangleScene& triangles_;
    const scene::View& view_;
    const scene::Image<std::uint32_t>& receivers_;
    bool has_eye_;
};

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
