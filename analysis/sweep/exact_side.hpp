#pragma once

#include "analysis/blocker_gaps.hpp"
#include "analysis/breakdown.hpp"
#include "analysis/causes.hpp"
#include "analysis/error_parts.hpp"
#include "analysis/first_hit_memory.hpp"
#include "analysis/gaps.hpp"
#include "analysis/map_errors.hpp"
#include "analysis/metrics.hpp"
#include "analysis/receiver_geometry.hpp"
#include "analysis/renderers.hpp"
#include "scene/exact_light.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// A camera before a light: what GL sees there and what is true, whatever the map.
struct SweepSubject {
    /// @param counts_parts  whether its pixels are told apart by object and light distance.
    SweepSubject(scene::ImageSize image, bool counts_parts)
        : gaps{image},
          first_hits{texels_each_pixel * image.pixel_count()},
          counts_parts_{counts_parts}
    {
    }

    scene::ReceiverLayers receivers;
    scene::TruthLayers truth;
    ClassCounts classes;
    BlockerGaps gaps;
    FirstHitMemory first_hits;

    /// The scored receivers by light distance; found anew only where that is counted otherwise than
    /// the last time.
    [[nodiscard]] std::shared_ptr<const Binning> distances(const scene::LightFrustum& frustum,
                                                           const ReceiverGeometry& geometry);
    /// The same with their objects; no parts if they are not to be counted.
    [[nodiscard]] std::shared_ptr<const PartMap> parts(const scene::LightFrustum& frustum,
                                                       const ReceiverGeometry& geometry,
                                                       const scene::TriangleScene& triangles);

private:
    /// Its pixels see at most one centre texel each of every map: room for maps of this many sizes.
    static constexpr std::size_t texels_each_pixel = 4;

    void count_from(const scene::LightFrustum& frustum);

    bool counts_parts_;
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const PartMap> parts_;
    scene::Vec3d distances_from_{}; ///< ζ is 0 there
    scene::Vec3d distances_along_{};
};

/// What exact rays say of a subject's lookups in maps that differ in nothing but the depth format:
/// found once, when it is first asked for.
class ExactSide {
public:
    /// @param view  of any of the jobs; no bias matters but a normal offset.
    ExactSide(const scene::TriangleScene& triangles, std::shared_ptr<SweepSubject> subject,
              const scene::Job& job, const scene::View& view, const Renderers& renderers);
    ExactSide(const ExactSide&) = delete;
    ExactSide& operator=(const ExactSide&) = delete;

    [[nodiscard]] const SweepSubject& subject() const { return *subject_; }
    [[nodiscard]] const scene::ExactLight& light() const { return *light_; }
    [[nodiscard]] const ReceiverGeometry& geometry() const { return geometry_; }
    /// The scored receivers by light distance.
    [[nodiscard]] const Binning& distances() const { return *distances_; }
    /// The scored receivers by object and light distance.
    [[nodiscard]] const PartMap& parts() const { return *parts_; }
    [[nodiscard]] BlockerGaps& gaps() { return subject_->gaps; }
    /// The gaps of these blocked pixels, in the order of the pixels.
    [[nodiscard]] std::vector<PixelGap> pixel_gaps(std::span<const std::size_t> pixels);

    [[nodiscard]] scene::Image<PixelCause> causes(const CauseInputs& inputs);
    [[nodiscard]] const CentreHits& centre_hits(const CauseInputs& inputs);
    /// Of these blocked pixels those whose shadow a bias detaches (`detached_pixels`).
    [[nodiscard]] std::vector<std::size_t> detached(const CauseInputs& inputs,
                                                    std::span<const std::size_t> pixels);

private:
    static constexpr std::uint8_t not_asked = 2;
    static constexpr PixelGap unknown_gap{std::numeric_limits<float>::quiet_NaN(), 0};

    /// The same, with what the side knows of texels.
    [[nodiscard]] CauseInputs with_known_hits(CauseInputs inputs);

    std::shared_ptr<SweepSubject> subject_;
    scene::View view_;
    int resolution_texels_;
    scene::Cull cull_;
    ReceiverGeometry geometry_;
    std::unique_ptr<scene::ExactLight> light_;
    std::shared_ptr<const Binning> distances_;
    std::shared_ptr<const PartMap> parts_;
    std::optional<CentreHits> centre_hits_;
    /// Only with a single tap what is found does not depend on the stored depths.
    bool remembers_;
    CauseMemory causes_;
    scene::Image<std::uint8_t> detaches_; ///< 1 yes, 0 no, or `not_asked`
    scene::Image<PixelGap> pixel_gaps_;   ///< or `unknown_gap`
};

} // namespace gnomon::analysis
