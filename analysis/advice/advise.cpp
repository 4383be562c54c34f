#include "analysis/advice/advise.hpp"

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/variants.hpp"
#include "analysis/bias/bias_units.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

class Adviser {
public:
    Adviser(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
            const Renderers& renderers)
        : comparison_{comparison},
          views_{views},
          file_{file},
          renderers_{renderers}
    {
    }

    void run()
    {
        for (const Variant& variant : variants_for(comparison_)) {
            try {
                try_variant(variant);
            } catch (const scene::InputError&) {
                if (variant.keys.empty()) {
                    throw;
                }
                // Otherwise the job's other keys exclude this change in some view.
            }
        }
    }

private:
    void try_variant(const Variant& variant)
    {
        BiasSearch search{file_, renderers_, views_.turns_light};
        for (const CheckedView& checked : views_.views) {
            search.add_view(with_view_of(variant.job, checked.view.job), checked);
        }
        const BiasLengths lengths = search.lengths();
        const auto slope = static_cast<float>(variant.job.bias.slope);
        const std::vector<ViewOutcome> as_it_is = search.measure_as_set(slope);
        if (variant.keys.empty()) {
            keep_views(as_it_is);
        } else {
            add(variant.job, variant.keys, as_it_is, std::nullopt);
            if (variant.mends_a_bias) {
                comparison_.advice.back().bias_change = BiasChange::mends;
            }
        }
        if (!scene::has_key(variant.job, "bias.constant")) {
            return;
        }
        const FoundBias found = search.find(no_limits(), slope);
        if (pooled(found.outcomes).metrics.pixels.of(scene::PixelClass::lit) == 0) {
            return; // the outcome could not show acne
        }
        const std::vector<ViewOutcome> measured = search.measure(found.rounded.bias, slope);
        const BiasLength length = lengths.of(found.rounded.bias);
        if (variant.keys.empty()) {
            needed_m_ = length.metres;
        }
        add_biased(variant, found.rounded, measured, length);
        if (variant.keys.empty() && views_.views.size() > 1) {
            recommend(found, search.measure(found.recommended.bias, slope), measured, lengths);
        }
    }

    /// Adds the variant with the rounded bias, unless its job sets that already.
    void add_biased(const Variant& variant, const RoundedBias& rounded,
                    const std::vector<ViewOutcome>& measured, const BiasLength& length)
    {
        const scene::BiasUnit& unit = *rounded.unit;
        Job biased = variant.job;
        scene::set_constant(biased.bias, unit, rounded.value);
        const bool is_new = &scene::bias_unit_of(variant.job.bias) != &unit ||
                            scene::constant_in_unit(variant.job.bias) != rounded.value;
        if (is_new) {
            std::vector<std::string> keys = variant.keys;
            keys.push_back(rounded.key);
            add(biased, std::move(keys), measured, length);
            comparison_.advice.back().bias_change = change_with(variant, length);
        }
    }

    /// @param constant  The constant bias to set along with the variant.
    [[nodiscard]] BiasChange change_with(const Variant& variant, const BiasLength& constant) const
    {
        if (variant.keys.empty()) {
            return std::abs(constant.depth) < std::abs(comparison_.view.bias.constant)
                       ? BiasChange::mends
                       : BiasChange::other;
        }
        return variant.mends_a_bias && std::abs(constant.metres) < std::abs(needed_m_)
                   ? BiasChange::mends_and_shortens
                   : BiasChange::other;
    }

    void add(const Job& job, std::vector<std::string> keys,
             const std::vector<ViewOutcome>& outcomes, const std::optional<BiasLength>& bias)
    {
        comparison_.advice.push_back({std::move(keys), outcome_of(outcomes.front()),
                                      outcomes.front().metrics.error_rate, lookup_cost(job),
                                      MeasuredBy::rerun, bias, outcomes, step_change(job)});
        comparison_.advice.back().job = std::make_shared<const Job>(job);
    }

    void keep_views(const std::vector<ViewOutcome>& now)
    {
        for (std::size_t i = 0; i < now.size(); ++i) {
            const AdviceView& view = views_.views[i].view;
            comparison_.advice_views.views.push_back(
                {view.name, *view.job.camera, *view.job.light, now[i]});
        }
        comparison_.advice_views.passed_over = views_.passed_over;
    }

    /// Recommends a bias for all views.
    /// @param with_exact, with_rounded  GL's outcomes at the exact and the rounded bias.
    void recommend(const FoundBias& found, const std::vector<ViewOutcome>& with_exact,
                   const std::vector<ViewOutcome>& with_rounded, const BiasLengths& lengths)
    {
        comparison_.diagnosis->curve.recommended =
            Recommendation{lengths.of(found.recommended.bias),
                           lengths.of(found.run.lo),
                           lengths.of(found.run.hi),
                           outcome_of(with_exact.front()),
                           found.rounded,
                           lengths.of(found.rounded.bias),
                           outcome_of(with_rounded.front()),
                           with_rounded.size(),
                           found.recommended.margin};
    }

    /// Size of a step of the stored depth at the median receiver, before and after the change.
    [[nodiscard]] DepthStepChange step_change(const Job& job) const
    {
        const scene::View view = scene::resolve_view(with_view_of(job, views_.own().view.job),
                                                     file_.scene, file_.defaults);
        const auto length_m = [&](const scene::View& of, const Job& with) {
            return depth_step_length_m(of.first_map(), with.shadow_map.depth_format,
                                       views_.own().median_light_distance_m);
        };
        return {length_m(comparison_.view, comparison_.job), length_m(view, job)};
    }

    double needed_m_ = 0; ///< the constant bias recommended for the unchanged job [m]
    Comparison& comparison_;
    const CheckedViews& views_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
};

} // namespace

Outcome outcome_of(const ViewOutcome& view)
{
    return {{view.metrics.false_shadow, view.metrics.false_lit},
            view.metrics.amounts,
            view.shadow_softening + view.light_softening,
            view.left_out().total()};
}

void advise(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
            const Renderers& renderers)
{
    if (!comparison.diagnosis) {
        throw std::invalid_argument("advise: comparison: has no diagnosis");
    }
    Adviser{comparison, views, file, renderers}.run();
}

} // namespace gnomon::analysis
