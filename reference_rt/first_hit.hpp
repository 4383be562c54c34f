#pragma once

#include "reference_rt/double_predicates.hpp"
#include "reference_rt/embree_scene.hpp"
#include "reference_rt/packet.hpp"
#include "reference_rt/receiver_raster.hpp"
#include "scene/job.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::reference_rt {

/// Whether GL's triangle is a first hit of the pixel's ray; the class and reason if it is not.
struct FirstHitVerdict {
    bool is_matched = false;
    scene::PixelClass pixel_class = scene::PixelClass::background;
    scene::ClassReason reason = scene::ClassReason::none;
};

/// Compares what GL sees with the first triangle that each pixel's ray meets beyond the near plane.
class FirstHits {
public:
    FirstHits(const ReferenceScene::Implementation& reference, const scene::View& view,
              const RasterFacts& facts);

    /// Embree's first hits of a packet of camera rays, `no_triangle` where there is none.
    [[nodiscard]] PacketOf<std::uint32_t> trace(const PacketMask& valid,
                                                const PacketOf<scene::Ray>& rays) const;

    /// Decides in double a pixel in which GL's triangle and Embree's differ.
    /// @param triangle  GL's, or `no_triangle`.
    [[nodiscard]] FirstHitVerdict settle(const scene::Ray& ray, int x, int y,
                                         std::uint32_t triangle) const;

private:
    struct Candidate {
        std::uint32_t triangle = scene::no_triangle;
        CameraHit hit;
    };
    struct Search;
    static void judge(const RTCFilterFunctionNArguments* arguments) noexcept;

    [[nodiscard]] std::optional<Candidate> candidate(const scene::Ray& ray,
                                                     std::uint32_t triangle) const;
    [[nodiscard]] std::optional<Candidate> nearest(const scene::Ray& ray) const;
    [[nodiscard]] bool is_tie(const scene::Ray& ray, int x, int y, const Candidate& seen,
                              const Candidate& nearest) const;

    const ReferenceScene::Implementation& reference_;
    double near_m_;
    ReceiverRaster raster_;
};

} // namespace gnomon::reference_rt
