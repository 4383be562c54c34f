#pragma once

#include "analysis/bias_rows.hpp"
#include "analysis/blocker_gaps.hpp"
#include "analysis/causes.hpp"
#include "analysis/comparison.hpp"
#include "analysis/receiver_geometry.hpp"
#include "analysis/renderers.hpp"
#include "analysis/sweep/results.hpp"
#include "scene/exact_light.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
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

/// One GL lookup, without constant and slope bias, and what it was made with.
struct SweepLookup {
    scene::Job job;
    scene::View view;
    scene::LookupLayers layers;
    scene::LookupLayers unmoved;    ///< without a normal offset; empty if the job has none
    scene::Image<float> map_depths; ///< as shaders see them; empty for `nearest`
};

/// What is asked of one bias curve.
struct CurveQuestion {
    struct Row {
        std::uint64_t ordinal = 0;
        float bias = 0;
    };
    std::string id;
    float slope = 0;    ///< depth units per unit of tan θ
    float job_bias = 0; ///< of the job without its axes: one of the error profiles
    std::vector<Row> rows;
};

/// Everything about one lookup that does not depend on constant and slope bias; answers for all of
/// them without GL. Not for `hardware`.
class LookupAnswers {
public:
    /// @param renderers  Only `make_exact_light` is called.
    LookupAnswers(const scene::TriangleScene& triangles, std::shared_ptr<SweepSubject> subject,
                  SweepLookup lookup, const Renderers& renderers);
    LookupAnswers(const LookupAnswers&) = delete;
    LookupAnswers& operator=(const LookupAnswers&) = delete;

    [[nodiscard]] FinishedCurve answer(const CurveQuestion& question);

private:
    [[nodiscard]] CauseInputs cause_inputs() const;
    [[nodiscard]] std::vector<PanningGap> panning_gaps(const scene::Image<float>& critical,
                                                       float largest_bias);
    void add_rows(const CurveQuestion& question, const scene::Image<float>& critical,
                  const LookupRule& rule, FinishedCurve& finished);

    std::shared_ptr<SweepSubject> subject_;
    SweepLookup lookup_;
    ReceiverGeometry geometry_;
    std::unique_ptr<scene::ExactLight> light_;
    LookupRule rule_;
    scene::LookupLayers deciding_;
    scene::Image<PixelCause> causes_;
    scene::Image<float> zeta_m_;
    scene::Image<float> map_error_m_;
    /// 1: a bias that lights this blocked pixel detaches its shadow; 0: not; 2: not asked yet.
    scene::Image<std::uint8_t> detaches_;
};

/// A configuration's row from its own comparison; the curve from its diagnosis.
/// @param job_bias  as in `CurveQuestion`.
[[nodiscard]] FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                                            std::uint64_t ordinal, float job_bias);

} // namespace gnomon::analysis
