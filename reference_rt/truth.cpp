#include "reference_rt/truth.hpp"

#include "reference_rt/embree_scene.hpp"
#include "reference_rt/first_hit.hpp"
#include "reference_rt/shadow_rays.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <limits>
#include <stdexcept>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::Image;
using scene::ImageSize;
using scene::no_triangle;
using scene::PixelClass;
using scene::Ray;
using scene::TruthLayers;
using scene::Vec3f;
using scene::View;

namespace {

void check_receivers(const Image<std::uint32_t>& receivers, ImageSize image,
                     std::size_t triangle_count, const char* function)
{
    if (receivers.size() != image) {
        throw std::invalid_argument{fmt::format(
            "{}: receivers are {}x{} pixels, the view {}x{}", function, receivers.size().width_px,
            receivers.size().height_px, image.width_px, image.height_px)};
    }
    for (const std::uint32_t triangle : receivers) {
        if (triangle != no_triangle && triangle >= triangle_count) {
            throw std::invalid_argument{fmt::format("{}: receiver {} of a scene of {} triangles",
                                                    function, triangle, triangle_count)};
        }
    }
}

/// Everything that is the same for all tiles of one image.
class TruthRun {
public:
    TruthRun(const ReferenceScene::Implementation& reference, const View& view,
             const Image<std::uint32_t>& receivers, const RasterFacts& raster, TruthMethod method)
        : reference_{reference},
          view_{view},
          receivers_{receivers},
          method_{method},
          first_hits_{reference, view, raster},
          layers_{Image<PixelClass>{view.image}, Image<ClassReason>{view.image},
                  Image<std::uint32_t>{view.image, no_triangle}}
    {
    }

    [[nodiscard]] int tile_columns() const
    {
        return (view_.image.width_px + tile_side_px - 1) / tile_side_px;
    }
    [[nodiscard]] int tile_rows() const
    {
        return (view_.image.height_px + tile_side_px - 1) / tile_side_px;
    }

    /// Classifies the pixels of one tile; different tiles may run at the same time.
    void classify_tile(int column, int row)
    {
        const Tile tile = gather(column, row);
        const auto first = first_hits_.trace(tile.valid, tile.rays);
        PacketMask open; // lanes that the shadow rays decide
        PacketOf<Receiver> receivers;
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (tile.valid[i] && is_open(tile, i, first[i], receivers[i])) {
                open.add(i);
            }
        }
        if (open.any()) {
            cast_shadow_rays(tile, open, receivers);
        }
    }

    [[nodiscard]] TruthLayers take() { return std::move(layers_); }

private:
    struct Tile {
        PacketMask valid;
        PacketOf<int> x{};
        PacketOf<int> y{};
        PacketOf<Ray> rays;
    };

    [[nodiscard]] Tile gather(int column, int row) const
    {
        Tile tile;
        for (std::size_t i = 0; i < packet_size; ++i) {
            tile.x[i] = column * tile_side_px + static_cast<int>(i) % tile_side_px;
            tile.y[i] = row * tile_side_px + static_cast<int>(i) / tile_side_px;
            if (tile.x[i] < view_.image.width_px && tile.y[i] < view_.image.height_px) {
                tile.valid.add(i);
                tile.rays[i] = pixel_ray(view_.camera, view_.image, tile.x[i], tile.y[i]);
            }
        }
        return tile;
    }

    /// True when pixel i is left to its shadow ray; else its class is written.
    bool is_open(const Tile& tile, std::size_t i, std::uint32_t first, Receiver& receiver)
    {
        const int x = tile.x[i];
        const int y = tile.y[i];
        const std::uint32_t triangle = receivers_(x, y);
        if (first != triangle) {
            const auto verdict = first_hits_.settle(tile.rays[i], x, y, triangle);
            if (!verdict.is_matched) {
                write(x, y, verdict.pixel_class, verdict.reason);
                return false;
            }
        } else if (triangle == no_triangle) {
            return false; // background, as the layers began
        }
        receiver =
            make_receiver(triangle, corners_of(reference_.triangles, triangle), tile.rays[i]);
        if (receiver.delta == 0) { // edge-on: float found a hit where there is no point P
            write(x, y, PixelClass::unmatched, ClassReason::snap);
            return false;
        }
        if (is_attached(receiver, view_.light)) {
            write(x, y, PixelClass::attached, ClassReason::none);
            return false;
        }
        if (is_out_of_light(receiver, view_.light)) {
            write(x, y, PixelClass::out_of_light, ClassReason::none);
            return false;
        }
        return true;
    }

    void cast_shadow_rays(const Tile& tile, const PacketMask& open,
                          const PacketOf<Receiver>& receivers)
    {
        if (method_ == TruthMethod::plain) {
            const auto is_blocked = trace_plain(reference_, view_.light, open, receivers);
            for (std::size_t i = 0; i < packet_size; ++i) {
                if (open[i]) {
                    write(tile.x[i], tile.y[i],
                          is_blocked[i] ? PixelClass::blocked : PixelClass::lit, ClassReason::none);
                }
            }
            return;
        }
        const auto contacts = trace_judged(reference_, view_.light, open, receivers);
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (open[i]) {
                const Shadowing shadowing = classify_segment(contacts[i]);
                write(tile.x[i], tile.y[i], shadowing.pixel_class, shadowing.reason);
                layers_.witness(tile.x[i], tile.y[i]) = contacts[i].witness;
            }
        }
    }

    void write(int x, int y, PixelClass pixel_class, ClassReason reason)
    {
        layers_.pixel_class(x, y) = pixel_class;
        layers_.reason(x, y) = reason;
    }

    const ReferenceScene::Implementation& reference_;
    const View& view_;
    const Image<std::uint32_t>& receivers_;
    TruthMethod method_;
    FirstHits first_hits_;
    TruthLayers layers_;
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

} // namespace

TruthLayers compute_truth(const ReferenceScene& reference, const View& view,
                          const Image<std::uint32_t>& receivers, const RasterFacts& raster,
                          const TruthOptions& options)
{
    const ReferenceScene::Implementation& implementation = reference.implementation();
    check_receivers(receivers, view.image, implementation.triangles.triangles.size(),
                    "compute_truth");
    TruthRun run{implementation, view, receivers, raster, options.method};
    with_threads(options.threads, [&] {
        tbb::parallel_for(tbb::blocked_range<int>{0, run.tile_rows()},
                          [&](const tbb::blocked_range<int>& rows) {
                              for (int row = rows.begin(); row != rows.end(); ++row) {
                                  for (int column = 0; column < run.tile_columns(); ++column) {
                                      run.classify_tile(column, row);
                                  }
                              }
                          });
    });
    implementation.errors.check("compute_truth");
    return run.take();
}

Image<Vec3f> receiver_points(const scene::TriangleScene& triangles, const View& view,
                             const Image<std::uint32_t>& receivers)
{
    check_receivers(receivers, view.image, triangles.triangles.size(), "receiver_points");
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Image<Vec3f> points{view.image, Vec3f{nan}};
    tbb::parallel_for(0, view.image.height_px, [&](int y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            const std::uint32_t triangle = receivers(x, y);
            if (triangle != no_triangle) {
                const Ray ray = pixel_ray(view.camera, view.image, x, y);
                points(x, y) =
                    Vec3f{make_receiver(triangle, corners_of(triangles, triangle), ray).point()};
            }
        }
    });
    return points;
}

std::string embree_version()
{
    return fmt::format("Embree {}", RTC_VERSION_STRING);
}

} // namespace gnomon::reference_rt
