#pragma once

#include "analysis/blocker_gaps.hpp"
#include "analysis/breakdown.hpp"
#include "analysis/causes.hpp"
#include "analysis/map_errors.hpp"
#include "analysis/metrics.hpp"
#include "analysis/receiver_geometry.hpp"
#include "analysis/renderers.hpp"
#include "scene/exact_light.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// A camera before a light: what GL sees there and what is true, whatever the map.
struct SweepSubject {
    explicit SweepSubject(scene::ImageSize image) : gaps{image} {}

    scene::ReceiverLayers receivers;
    scene::TruthLayers truth;
    ClassCounts classes;
    BlockerGaps gaps;
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
    [[nodiscard]] const Binning& distances() const { return distances_; }
    [[nodiscard]] BlockerGaps& gaps() { return subject_->gaps; }

    [[nodiscard]] scene::Image<PixelCause> causes(const CauseInputs& inputs);
    [[nodiscard]] const CentreHits& centre_hits(const CauseInputs& inputs);
    /// Of these blocked pixels those whose shadow a bias detaches (`detached_pixels`).
    [[nodiscard]] std::vector<std::size_t> detached(const CauseInputs& inputs,
                                                    std::span<const std::size_t> pixels);

private:
    static constexpr std::uint8_t not_asked = 2;

    std::shared_ptr<SweepSubject> subject_;
    scene::View view_;
    ReceiverGeometry geometry_;
    std::unique_ptr<scene::ExactLight> light_;
    Binning distances_;
    std::optional<CentreHits> centre_hits_;
    /// Only with a single tap what is found does not depend on the stored depths.
    bool remembers_;
    CauseMemory causes_;
    scene::Image<std::uint8_t> detaches_; ///< 1 yes, 0 no, or `not_asked`
};

} // namespace gnomon::analysis
