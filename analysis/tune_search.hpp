#pragma once

#include "analysis/lookup/critical_bias.hpp"
#include "analysis/tune.hpp"
#include "scene/layers.hpp"

namespace gnomon::analysis {

/// Finds constant biases for one shadow map and one normal offset: one lookup answers for all
/// slopes and biases. The map must be the one drawn last.
class BiasSearch {
public:
    /// All arguments must outlive the search.
    BiasSearch(const scene::Job& job, const scene::View& view, const scene::TruthLayers& truth,
               const Renderers& renderers);

    /// Finds the best constant bias in [0, 1] for the setting's slope: with the fewest errors among
    /// those that meet the limits, or among all if none does.
    void find_constant(const TuneLimits& limits, TunedSetting& setting) const;

private:
    void search_curve(const TuneLimits& limits, TunedSetting& setting) const;
    void search_by_rendering(const TuneLimits& limits, TunedSetting& setting) const;

    const scene::Job& job_;
    const scene::View& view_;
    const scene::TruthLayers& truth_;
    const Renderers& renderers_;
    scene::LookupLayers deciding_; ///< empty for `hardware`
};

} // namespace gnomon::analysis
