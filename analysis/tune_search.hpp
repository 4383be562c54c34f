#pragma once

#include "analysis/answers/lookup_answers.hpp"
#include "analysis/tune.hpp"
#include "scene/layers.hpp"

#include <memory>

namespace gnomon::analysis {

/// A camera before a light: what is seen there, and what is true of it.
struct JudgedView {
    const scene::TriangleScene& triangles;
    const scene::ReceiverLayers& receivers;
    const scene::TruthLayers& truth;
};

/// Finds constant biases for one shadow map and one normal offset: one lookup answers for all
/// slopes and biases. The map must be the one drawn last.
class BiasSearch {
public:
    /// All arguments, and what `judged` refers to, must outlive the search.
    /// @throws scene::InputError  where verdicts can be fractions and the renderers have no exact
    ///                            light, which tells softened borders from errors.
    BiasSearch(const scene::Job& job, const scene::View& view, const JudgedView& judged,
               const Renderers& renderers);

    /// Finds the best constant bias in [0, 1] for the setting's slope: the one that is least wrong
    /// among those that meet the limits, or among all if none does.
    void find_constant(const TuneLimits& limits, TunedSetting& setting) const;

    /// What a kernel softens on purpose in the verdicts of a lookup with these biases; 0 where
    /// verdicts are no fractions.
    [[nodiscard]] double softening_of(const scene::LookupLayers& own,
                                      const scene::Bias& bias) const;

private:
    void search_curve(const TuneLimits& limits, TunedSetting& setting) const;
    void search_fractions(const TuneLimits& limits, TunedSetting& setting) const;
    [[nodiscard]] std::vector<MeasuredBias> measured_on_curve(float slope) const;
    [[nodiscard]] std::vector<MeasuredBias> measured_by_gl(float slope) const;

    const scene::Job& job_;
    const scene::View& view_;
    JudgedView judged_;
    const Renderers& renderers_;
    scene::LookupLayers deciding_;           ///< empty where verdicts are fractions
    std::unique_ptr<LookupAnswers> answers_; ///< there alone
};

} // namespace gnomon::analysis
