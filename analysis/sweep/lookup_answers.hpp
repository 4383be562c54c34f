#pragma once

#include "analysis/bias_rows.hpp"
#include "analysis/causes.hpp"
#include "analysis/comparison.hpp"
#include "analysis/sweep/curve_question.hpp"
#include "analysis/sweep/exact_side.hpp"
#include "analysis/sweep/results.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// One GL lookup, without constant and slope bias, and what it was made with.
struct SweepLookup {
    scene::Job job;
    scene::View view;
    scene::LookupLayers layers;
    scene::LookupLayers unmoved;    ///< without a normal offset; empty if the job has none
    scene::Image<float> map_depths; ///< as shaders see them; empty for `nearest`
};

/// Everything about one lookup that does not depend on constant and slope bias; answers for all of
/// them without GL. Not for `hardware`.
class LookupAnswers {
public:
    LookupAnswers(std::shared_ptr<ExactSide> exact, SweepLookup lookup);
    LookupAnswers(const LookupAnswers&) = delete;
    LookupAnswers& operator=(const LookupAnswers&) = delete;

    [[nodiscard]] FinishedCurve answer(const CurveQuestion& question);
    /// The critical bias of each pixel; for its argument see `CurveQuestion`.
    [[nodiscard]] scene::Image<float> critical_biases(float slope) const;

private:
    [[nodiscard]] CauseInputs cause_inputs() const;
    [[nodiscard]] scene::LookupLayers make_deciding() const;
    [[nodiscard]] const scene::LookupLayers& deciding() const
    {
        return own_deciding_.samples.empty() ? lookup_.layers : own_deciding_;
    }
    [[nodiscard]] const scene::Image<scene::PixelClass>& classes() const
    {
        return exact_->subject().truth.pixel_class;
    }
    [[nodiscard]] std::vector<PanningGap> panning_gaps(const scene::Image<float>& critical,
                                                       float largest_bias);
    void add_rows(const CurveQuestion& question, const scene::Image<float>& critical,
                  const BiasCurve& curve, const LookupRule& rule, FinishedCurve& finished);

    std::shared_ptr<ExactSide> exact_;
    SweepLookup lookup_;
    LookupRule rule_;
    scene::LookupLayers own_deciding_; ///< pcfK; other lookups decide by the depth they return
    scene::Image<PixelCause> causes_;
    scene::Image<float> map_error_m_;
};

/// A configuration's row from its own comparison; the curve from its diagnosis, empty if it is
/// another renderer's and has none.
/// @param job_bias  as in `CurveQuestion`.
[[nodiscard]] FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                                            std::uint64_t ordinal, float job_bias);

} // namespace gnomon::analysis
