#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/recommendation/broad_minimum.hpp"
#include "analysis/recommendation/minimum_search.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "analysis/recommendation/rounded_bias.hpp"
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

/// The constant bias that is recommended for some views, with one slope.
struct FoundBias {
    BiasInterval run; ///< the valley's, in the job's own view; hi infinite: nothing limits it
    RecommendedBias recommended;       ///< in the job's own view
    RoundedBias rounded;               ///< the same with few digits, as a job file has it
    std::vector<ViewOutcome> outcomes; ///< with the pasted one, by view
    bool meets_limits = false;         ///< in every view
    BiasLength length; ///< of the pasted bias, and of the valley's ends, in the job's own view
    BiasLength low;
    BiasLength high;

    /// In the job's own view [depth units].
    [[nodiscard]] float constant() const { return outcomes.front().constant; }
};

/// Finds constant biases for one shadow map, filter and normal offset over several views: one
/// lookup in each answers for all slopes and biases. Views of one light share the bias in depth
/// units; under different lights they share its length in metres, at each one's median receiver.
/// Where nothing tells of other biases each is tried, four a decade; of methods without bias terms
/// 0 alone.
class BiasSearch {
public:
    /// All arguments, and the views added, must outlive the search.
    /// @param in_metres  Whether the views' lights differ.
    BiasSearch(const scene::SceneFile& file, const Renderers& renderers, bool in_metres);

    /// Draws the view's receivers and map with these settings, and looks them up.
    /// @param job  With the view's camera and light; its constant bias is that of `measure_as_set`,
    ///             its slope is not looked at.
    /// @throws scene::InputError  where verdicts can be fractions and the renderers have no exact
    ///                            light, which tells softened borders from errors.
    void add_view(const scene::Job& job, const CheckedView& judged);
    [[nodiscard]] std::size_t view_count() const { return views_.size(); }
    [[nodiscard]] const scene::View& own_view() const { return views_.front().view; }
    /// What makes biases of the first view lengths.
    [[nodiscard]] BiasLengths lengths() const;

    /// The recommended constant bias, within the limits where they can be met: with few digits, if
    /// such a one will do. Where each verdict is one comparison, limits that are not met then
    /// cannot be met with any constant bias, but for what carrying it in metres rounds.
    /// Source: docs/bias_curve.md#what-is-recommended.
    [[nodiscard]] FoundBias find(const TuneLimits& limits, float slope,
                                 BiasSteps steps = BiasSteps::fine) const;

    /// What GL itself gives in each view, in the order in which they were added, with the constant
    /// bias that its job sets, and a slope.
    [[nodiscard]] std::vector<ViewOutcome> measure_as_set(float slope) const;
    /// What GL itself gives in each view, in the same order, with a constant bias and slope.
    /// @param constant  In the first view; carried to the others.
    [[nodiscard]] std::vector<ViewOutcome> measure(float constant, float slope) const;

private:
    struct SearchedView {
        scene::Job job;
        scene::View view;
        float set_constant = 0;        ///< of its job [depth units]
        std::vector<float> set_scales; ///< that go with it (`scene::View::bias_scales`)
        const CheckedView* judged = nullptr;
        std::size_t read_map = 0;               ///< that most receivers read
        scene::LookupLayers deciding;           ///< empty where verdicts are fractions
        std::unique_ptr<LookupAnswers> answers; ///< there alone, and where a curve tells of biases
        /// What answers are made of for each bias anew, where none does.
        std::shared_ptr<LightQueryCache> exact;
    };
    /// A valley of all views, and the biases that meet the limits in each of them, in the units of
    /// the first.
    struct ViewsMinimum {
        std::optional<BroadMinimum> broad_minimum;
        std::vector<BiasInterval> allowed; ///< ascending; empty: the limits cannot be met
    };

    /// What a lookup of the view needs: drawn, where it is not what was drawn last.
    [[nodiscard]] const renderers::Drawn& drawn(std::size_t view) const;
    [[nodiscard]] scene::LookupLayers look_up(std::size_t view, const scene::View& biased) const;
    /// @param biased  the view's.
    [[nodiscard]] ObservedLookup observe(std::size_t view, const scene::View& biased,
                                         scene::LookupLayers own) const;
    [[nodiscard]] bool has_fractions() const;
    /// Whether a lookup tells of every other constant bias, or GL finds the critical ones.
    [[nodiscard]] bool has_curve() const;
    /// Whether every constant bias follows from one lookup of each view.
    [[nodiscard]] bool has_formula() const;
    /// Whether one lookup tells each bias's errors: then they are counted, else measured.
    [[nodiscard]] bool counts_errors() const { return !has_fractions() && has_formula(); }
    [[nodiscard]] std::vector<BiasCurve> curves(float slope) const;
    [[nodiscard]] ViewsMinimum minimum_of(const std::vector<BiasCurve>& curves,
                                          const TuneLimits& limits) const;
    [[nodiscard]] ViewsMinimum minimum_of_fractions(const TuneLimits& limits, float slope,
                                                    BiasSteps steps) const;
    /// What the views give at each of the first one's biases, by bias.
    using OutcomesByBias = std::map<float, std::vector<ViewOutcome>>;
    /// Asks the views, all together, and keeps what each of them gives.
    [[nodiscard]] AskedCurve asked(float slope, OutcomesByBias& kept) const;
    /// What is softened in a view with a constant bias of 0.
    [[nodiscard]] Softening softening_at_zero(std::size_t view, float slope) const;
    /// The amounts of error in a view with each of its biases.
    [[nodiscard]] std::vector<ErrorAmounts> amounts_in(std::size_t view, float slope,
                                                       std::span<const float> biases) const;
    [[nodiscard]] static Metrics measured(const SearchedView& searched,
                                          const scene::LookupLayers& own);
    [[nodiscard]] static scene::View biased_view(const SearchedView& searched, float constant,
                                                 float slope, const std::vector<float>& scales);
    /// The causes' amounts of a lookup's verdicts; nothing where each is one comparison.
    [[nodiscard]] CauseAmounts amounts_of(std::size_t view, const scene::View& biased,
                                          const scene::LookupLayers& own) const;
    /// The amounts of error of all views together, at each of the first view's biases.
    [[nodiscard]] std::vector<ErrorAmounts> pooled_amounts(float slope,
                                                           std::span<const float> biases) const;
    /// What each of them gives in a view.
    [[nodiscard]] std::vector<ViewOutcome> outcomes_in(std::size_t view, float slope,
                                                       std::span<const float> biases) const;
    [[nodiscard]] ViewOutcome measured_by_gl(std::size_t view, float constant, float slope,
                                             const std::vector<float>& scales) const;
    /// The bias to take of a valley, in the first view, and the same with few digits.
    [[nodiscard]] RecommendedBias recommended_of(const ViewsMinimum& found) const;
    [[nodiscard]] RoundedBias rounded_of(const ViewsMinimum& found,
                                         const RecommendedBias& recommended) const;
    /// Whether views share the bias's length, and not its depth units.
    [[nodiscard]] bool shares_metres() const
    {
        return in_metres_ || !scene::bias_unit_of(told_like_).is_depth();
    }
    /// A bias of the first view in another, and back.
    [[nodiscard]] float carried(std::size_t to, float bias) const;
    [[nodiscard]] std::vector<float> carried(std::size_t to, std::span<const float> biases) const;
    [[nodiscard]] float carried_back(std::size_t from, float bias) const;

    const scene::SceneFile& file_;
    const Renderers& renderers_;
    bool in_metres_;
    scene::BiasSettings told_like_; ///< the unit that a job's biases are told in
    std::vector<SearchedView> views_;
    /// For methods without a bias curve: the softening at a bias of 0, by view and slope.
    mutable std::map<std::pair<std::size_t, float>, Softening> softening_at_zero_;
    mutable std::optional<std::size_t> drawn_view_; ///< whose receivers and map are drawn
    mutable renderers::Drawn drawn_;
};

} // namespace gnomon::analysis
