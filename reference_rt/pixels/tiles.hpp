#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/lane_rays.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "scene/image.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::reference_rt {

/// A tile of 4×4 pixels with GL's triangles and the rays' hits on them. Each worker refills its own
/// tile.
class Tile {
public:
    LaneBits valid = 0; ///< lanes inside the image
    LaneBits seen = 0;  ///< lanes in which GL saw a triangle
    int left = 0;       ///< first column
    int top = 0;
    LaneRays rays{};
    LaneHits hits{}; ///< for lanes in `seen`
    Lanes<std::uint32_t> triangles{};
    std::size_t face_count = 0;
    PacketOf<ExactTriangle> faces; ///< the distinct triangles
    PacketOf<LaneBits> face_lanes{};

    [[nodiscard]] int x(std::size_t lane) const
    {
        return left + static_cast<int>(lane) % tile_side_px;
    }
    [[nodiscard]] int y(std::size_t lane) const
    {
        return top + static_cast<int>(lane) / tile_side_px;
    }
    /// GL's triangle in a lane in `seen`.
    [[nodiscard]] const ExactTriangle& face(std::size_t lane) const;
    /// The receiver of a lane in `seen`; made on first use, valid until the tile is refilled.
    [[nodiscard]] const Receiver& receiver(std::size_t lane) const
    {
        SignCounts ignored; // the sign of δ is already counted
        return receiver(lane, ignored);
    }
    /// The receivers of lanes in `seen`; other lanes are undefined.
    [[nodiscard]] const PacketOf<Receiver>& receivers() const;

private:
    friend class TileSource;

    [[nodiscard]] const Receiver& receiver(std::size_t lane, SignCounts& counts) const;

    mutable LaneBits made_ = 0;
    mutable PacketOf<CameraRay> camera_rays_;
    mutable PacketOf<Receiver> receivers_;
};

/// Fills tiles from GL's triangle indices.
class TileSource {
public:
    /// @param receivers  GL's triangle per pixel. All arguments must outlive this object.
    TileSource(const scene::TriangleScene& triangles, const scene::View& view,
               const scene::Image<std::uint32_t>& receivers);

    void fill(Tile& tile, int column, int row, SignCounts& counts) const;

private:
    void find_rays(Tile& tile) const;
    void look_up(Tile& tile) const;
    void find_faces(Tile& tile) const;
    void find_hits(Tile& tile, SignCounts& counts) const;

    const scene::TriangleScene& triangles_;
    const scene::View& view_;
    const scene::Image<std::uint32_t>& receivers_;
    bool has_eye_;           ///< whether all rays share one origin
    std::vector<double> sx_; ///< of each column, up to a whole number of tiles
    std::vector<double> sy_; ///< of each row
};

/// Runs `job` with this many threads; 0 means all cores.
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

/// A task context that gives worker threads the caller's floating-point settings, as Embree may
/// have set pool threads to flush subnormal numbers.
class CallerFloatSettings {
public:
    [[nodiscard]] tbb::task_group_context& context() { return context_; }

private:
    tbb::task_group_context context_{tbb::task_group_context::isolated,
                                     tbb::task_group_context::default_traits |
                                         tbb::task_group_context::fp_settings};
};

/// Calls `run(column, row)` in parallel for every tile of the image.
template <typename Run>
void for_each_tile(scene::ImageSize image, int threads, const Run& run)
{
    const int columns = (image.width_px + tile_side_px - 1) / tile_side_px;
    const int rows = (image.height_px + tile_side_px - 1) / tile_side_px;
    CallerFloatSettings same;
    with_threads(threads, [&] {
        tbb::parallel_for(
            tbb::blocked_range<int>{0, rows},
            [&](const tbb::blocked_range<int>& range) {
                for (int row = range.begin(); row != range.end(); ++row) {
                    for (int column = 0; column < columns; ++column) {
                        run(column, row);
                    }
                }
            },
            tbb::auto_partitioner{}, same.context());
    });
}

} // namespace gnomon::reference_rt
