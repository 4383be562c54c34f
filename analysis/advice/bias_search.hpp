#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/recommendation/broad_minimum.hpp"
#include "analysis/recommendation/minimum_search.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// The recommended constant bias for some views at one slope.
struct FoundBias {
    BiasInterval run; ///< of the broad minimum, in the job's own view; hi infinite: no upper limit
    RecommendedBias recommended;       ///< in the job's own view
    RoundedBias rounded;               ///< with few digits, as a job file writes it
    std::vector<ViewOutcome> outcomes; ///< at the rounded bias, by view
    bool meets_limits = false;         ///< in every view
    BiasLength length; ///< of the rounded bias, in the job's own view; `low` and `high`: the
                       ///< minimum's ends
    BiasLength low;
    BiasLength high;

    /// The rounded bias in the job's own view [depth units].
    [[nodiscard]] float constant() const { return outcomes.front().constant; }
};

/// Finds constant biases for one shadow map, filter and normal offset over several views. One
/// lookup in each view answers for all slopes and biases. Views of one light share the bias in
/// depth units. Under different lights they share its length in metres at each one's median
/// receiver. If nothing evaluates other biases, tries four for each decade; for methods without
/// bias terms, only 0.
class BiasSearch {
public:
    /// All arguments, and the views added, must outlive this.
    /// @param in_metres  Whether the views' lights differ.
    BiasSearch(const scene::SceneFile& file, const Renderers& renderers, bool in_metres);

    /// Draws the view's receivers and map with these settings, and looks them up.
    /// @param job  With the view's camera and light. `measure_as_set` uses its constant bias; its
    ///             slope is ignored.
    /// @throws scene::InputError  if verdicts can be fractions and the renderers have no exact
    ///                            light, which distinguishes softened borders from errors.
    void add_view(const scene::Job& job, const CheckedView& checked);
    [[nodiscard]] std::size_t view_count() const { return views_.size(); }
    [[nodiscard]] const scene::View& own_view() const { return views_.front().view; }
    /// Converts biases of the first view to lengths.
    [[nodiscard]] BiasLengths lengths() const;

    /// The recommended constant bias, within the limits if they can be met, and with few digits if
    /// such a bias serves. If each verdict is one comparison and the result does not meet the
    /// limits, then no constant bias does, up to rounding when converted through metres.
    /// Source: docs/bias_curve.md#what-is-recommended.
    [[nodiscard]] FoundBias find(const TuneLimits& limits, float slope,
                                 BiasSteps steps = BiasSteps::fine) const;

    /// GL's own errors in each view, in the order in which views were added, at the constant bias
    /// that its job sets and this slope.
    [[nodiscard]] std::vector<ViewOutcome> measure_as_set(float slope) const;
    /// GL's own errors in each view, in that order, at this constant bias and slope.
    /// @param constant  In the first view; converted for the others.
    [[nodiscard]] std::vector<ViewOutcome> measure(float constant, float slope) const;

private:
    struct SearchedView {
        scene::Job job;
        scene::View view;
        float set_constant = 0;        ///< the job's constant bias [depth units]
        std::vector<float> set_scales; ///< scales of that bias (`scene::View::bias_scales`)
        const CheckedView* checked = nullptr;
        std::size_t read_map = 0;     ///< the map that most receivers read
        scene::LookupLayers deciding; ///< empty if verdicts are fractions
        /// Only if verdicts are fractions and a curve evaluates biases.
        std::unique_ptr<LookupAnswers> answers;
        /// Reused for each bias if there are no `answers`.
        std::shared_ptr<LightQueryCache> exact;
    };
    /// A broad minimum over all views, and the biases that meet the limits in every view, in the
    /// units of the first.
    struct ViewsMinimum {
        std::optional<BroadMinimum> broad_minimum;
        std::vector<BiasInterval> allowed; ///< ascending; empty if the limits cannot be met
    };

    /// Settings with the unit of biases that all views can share: under several directional lights
    /// metres instead of depth units.
    [[nodiscard]] scene::BiasSettings shared_bias_settings(const scene::Job& job) const;
    /// Map and receivers of the view; draws them unless they were drawn last.
    [[nodiscard]] const renderers::Drawn& drawn(std::size_t view) const;
    [[nodiscard]] scene::LookupLayers look_up(std::size_t view, const scene::View& biased) const;
    /// @param biased  The view with biases.
    [[nodiscard]] ObservedLookup observe(std::size_t view, const scene::View& biased,
                                         scene::LookupLayers own) const;
    [[nodiscard]] bool has_fractions() const;
    /// Whether a formula or GL gives every critical bias.
    [[nodiscard]] bool has_curve() const;
    /// Whether one lookup of each view gives every constant bias.
    [[nodiscard]] bool has_formula() const;
    /// Whether one lookup gives the errors at each bias, so that they are counted, not measured.
    [[nodiscard]] bool counts_errors() const { return !has_fractions() && has_formula(); }
    [[nodiscard]] std::vector<BiasCurve> curves(float slope) const;
    [[nodiscard]] ViewsMinimum minimum_of(const std::vector<BiasCurve>& curves,
                                          const TuneLimits& limits) const;
    [[nodiscard]] ViewsMinimum minimum_of_fractions(const TuneLimits& limits, float slope,
                                                    BiasSteps steps) const;
    /// The outcomes of all views, by bias of the first view.
    using OutcomesByBias = std::map<float, std::vector<ViewOutcome>>;
    /// A curve that samples all views together; keeps their outcomes in `kept`.
    [[nodiscard]] SampledCurve sampled_curve(float slope, OutcomesByBias& kept) const;
    /// The softening in a view at a constant bias of 0.
    [[nodiscard]] Softening softening_at_zero(std::size_t view, float slope) const;
    /// The amounts of error in a view at each of its biases.
    [[nodiscard]] std::vector<ErrorAmounts> amounts_in(std::size_t view, float slope,
                                                       std::span<const float> biases) const;
    [[nodiscard]] static Metrics measured(const SearchedView& searched,
                                          const scene::LookupLayers& own);
    [[nodiscard]] static scene::View biased_view(const SearchedView& searched, float constant,
                                                 float slope, const std::vector<float>& scales);
    /// Error amounts of a lookup's verdicts, by cause; empty if each verdict is one comparison.
    [[nodiscard]] CauseAmounts amounts_of(std::size_t view, const scene::View& biased,
                                          const scene::LookupLayers& own) const;
    /// The amounts of error of all views together, at each of the first view's biases.
    [[nodiscard]] std::vector<ErrorAmounts> pooled_amounts(float slope,
                                                           std::span<const float> biases) const;
    /// The outcomes in one view at each of the biases.
    [[nodiscard]] std::vector<ViewOutcome> outcomes_in(std::size_t view, float slope,
                                                       std::span<const float> biases) const;
    [[nodiscard]] ViewOutcome measured_by_gl(std::size_t view, float constant, float slope,
                                             const std::vector<float>& scales) const;
    /// The bias to recommend from a broad minimum, in the first view, and the rounded one.
    [[nodiscard]] RecommendedBias recommended_of(const ViewsMinimum& found) const;
    [[nodiscard]] RoundedBias rounded_of(const ViewsMinimum& found,
                                         const RecommendedBias& recommended) const;
    /// Whether views share the bias's length instead of its depth units.
    [[nodiscard]] bool shares_metres() const
    {
        return in_metres_ || !scene::bias_unit_of(bias_settings_).is_depth();
    }
    /// Converts a bias from the first view to another, and back.
    [[nodiscard]] float converted(std::size_t to, float bias) const;
    [[nodiscard]] std::vector<float> converted(std::size_t to, std::span<const float> biases) const;
    [[nodiscard]] float converted_back(std::size_t from, float bias) const;

    const scene::SceneFile& file_;
    const Renderers& renderers_;
    bool in_metres_;
    scene::BiasSettings bias_settings_; ///< determine the unit in which biases are reported
    std::vector<SearchedView> views_;
    /// For methods without a bias curve: the softening at a bias of 0, by view and slope.
    mutable std::map<std::pair<std::size_t, float>, Softening> softening_at_zero_;
    /// The view whose receivers and map are in `drawn_`.
    mutable std::optional<std::size_t> drawn_view_;
    mutable renderers::Drawn drawn_;
};

} // namespace gnomon::analysis
