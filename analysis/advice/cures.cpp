#include "analysis/advice/cures.hpp"

#include "analysis/advice/map_fit.hpp"
#include "analysis/advice/remedies.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

/// The errors with a job's settings.
struct RemainingErrors {
    Outcome outcome;
    NamedErrors by_name;
};

/// Draws the job's map for the receivers of a comparison, and explains the wrong pixels.
RemainingErrors explain(const Job& job, const Comparison& own, const scene::SceneFile& file,
                        const Renderers& renderers)
{
    const scene::View view = scene::resolve_view(job, file.scene, file.defaults);
    renderers::Rasterizer& rasterizer = renderers.rasterizer;
    const renderers::Drawn drawn{rasterizer.draw_receivers(view),
                                 renderers::draw_filtered_map(rasterizer, job, view)};
    const scene::ReceiverLayers receivers = drawn.receivers->layers();
    const scene::LookupLayers lookup = rasterizer.look_up({drawn, job, view});
    const Metrics metrics = measure(own.truth, lookup, methods::traits(job).equal_taps());
    auto judged =
        std::make_shared<ScoredReceivers>(receivers, own.truth, ReceiverUse{false, false});
    const auto exact = std::make_shared<LightQueryCache>(file.scene, std::move(judged), job, view,
                                                         renderers.reference);
    ObservedLookup observed = observe_lookup(
        job, view, file.scene, lookup, [drawn = drawn] { return drawn; }, rasterizer);
    const auto without_constant = std::move(observed.without_constant);
    LookupAnswers answers{exact, std::move(observed)};
    const CauseLayers causes =
        answers.causes().causes_of(lookup, view.bias.constant, view.bias.slope);
    const Softening softening{causes.amounts.shadow_softening, causes.amounts.light_softening};
    const Softening at_zero =
        answers.causes().has_curve() ? answers.measures().softening_at_zero(view.bias.slope)
        : without_constant           ? softening_without_constant(without_constant(), exact)
                                     : softening;
    const double no_error = left_out(softening, at_zero).total();
    return {
        {{metrics.false_shadow, metrics.false_lit}, metrics.amounts, softening.total(), no_error},
        named_errors(causes.counts, causes.amounts, has_fractions(metrics), no_error)};
}

/// The job with the cure of a cause; no keys if the cause has no cure.
struct CureJob {
    Job job;
    std::vector<std::string> keys;

    void set(std::string key) { keys.push_back(std::move(key)); }
};

CureJob cure_of_precision(const Job& job)
{
    CureJob cure{job, {}};
    if (traits_of(job.shadow_map.depth_format).significant_bits !=
        traits_of(scene::float_depth_format).significant_bits) {
        cure.job.shadow_map.depth_format = scene::float_depth_format;
        cure.set("shadow_map.depth_format = \"d32f\"");
    }
    return cure;
}

CureJob cure_of_filter(const Job& job)
{
    CureJob cure{job, {}};
    if (scene::has_filters(job) && job.lookup.filter != scene::Filter::nearest) {
        cure.job.lookup.filter = scene::Filter::nearest;
        cure.set("lookup.filter = \"nearest\"");
    }
    return cure;
}

/// Larger maps are not tried: they exceed the key's range or this much memory.
constexpr int finest_cure_texels = 16384;
constexpr std::uint64_t most_map_bytes = std::uint64_t{1} << 30;

CureJob cure_of_resolution(const Job& job)
{
    CureJob cure{job, {}};
    const int resolution = 4 * job.shadow_map.resolution_texels;
    if (resolution > finest_cure_texels) {
        return cure;
    }
    cure.job.shadow_map.resolution_texels = resolution;
    if (methods::traits(cure.job).map_bytes <= most_map_bytes) {
        cure.set(fmt::format("shadow_map.resolution = {}", resolution));
    }
    return cure;
}

CureJob cure_of_coverage(const Job& job)
{
    CureJob cure{job, {}};
    scene::ShadowMapSettings& map = cure.job.shadow_map;
    if (map.cull != scene::Cull::none) {
        map.cull = scene::Cull::none;
        cure.set("shadow_map.cull = \"none\"");
    }
    if (map.frustum.fit != scene::Fit::scene) {
        cure.set("shadow_map." + fit_setting(map.frustum.fit, scene::Fit::scene));
        map.frustum.fit = scene::Fit::scene;
    }
    if (std::exchange(map.frustum.near_m, {})) {
        cure.set("shadow_map.near = \"auto\"");
    }
    if (std::exchange(map.frustum.far_m, {})) {
        cure.set("shadow_map.far = \"auto\"");
    }
    return cure;
}

CureJob cure_of(Cause cause, const Job& job)
{
    switch (cause) {
    case Cause::precision:
        return cure_of_precision(job);
    case Cause::filter:
        return cure_of_filter(job);
    case Cause::resolution:
        return cure_of_resolution(job);
    case Cause::coverage:
        return cure_of_coverage(job);
    case Cause::bias: // in the remedies already
    case Cause::none:
        break;
    }
    return {job, {}};
}

/// A measured change as the cure of a cause.
Cure as_cure(Cause cause, double laid, const Remedy& remedy)
{
    return {cause, remedy.keys, laid, remedy.outcome, remedy.measured_by, remedy.left};
}

/// The measured change of a kind that leaves the least error; null if there is none.
template <typename Is>
const Remedy* best_of(const std::vector<Remedy>& advice, const Is& is)
{
    const Remedy* best = nullptr;
    for (const Remedy& remedy : advice) {
        if (is(remedy) &&
            (best == nullptr || remedy.outcome.error_amount() < best->outcome.error_amount())) {
            best = &remedy;
        }
    }
    return best;
}

class Explainer {
public:
    Explainer(Comparison& comparison, const scene::SceneFile& file, const Renderers& renderers)
        : comparison_{comparison},
          file_{file},
          renderers_{renderers},
          errors_{named_errors(comparison)}
    {
    }

    void run()
    {
        for (const Cause cause :
             {Cause::precision, Cause::filter, Cause::resolution, Cause::coverage}) {
            if (is_worth_naming(errors_.by_cause, static_cast<std::size_t>(cause))) {
                try_cure(cause);
            }
        }
        add_measured(Cause::precision, best_of(comparison_.advice, moves_origin));
        add_measured(Cause::bias, best_of(comparison_.advice, [](const Remedy& remedy) {
                         return remedy.bias_change == BiasChange::mends;
                     }));
        explain_first();
    }

private:
    static bool moves_origin(const Remedy& remedy)
    {
        return remedy.keys.front().starts_with(origin_comment);
    }

    void try_cure(Cause cause)
    {
        CureJob cure = cure_of(cause, comparison_.job);
        if (cure.keys.empty()) {
            return;
        }
        try {
            RemainingErrors left = explain(cure.job, comparison_, file_, renderers_);
            comparison_.cures.push_back({cause, std::move(cure.keys), errors_.of(cause),
                                         left.outcome, MeasuredBy::rerun, left.by_name});
        } catch (const scene::InputError&) {
            return; // the job's other keys exclude this cure
        }
    }

    void add_measured(Cause cause, const Remedy* remedy)
    {
        if (remedy != nullptr &&
            is_worth_naming(errors_.by_cause, static_cast<std::size_t>(cause))) {
            comparison_.cures.push_back(as_cure(cause, errors_.of(cause), *remedy));
        }
    }

    /// Explains the errors that the best remedy leaves.
    void explain_first()
    {
        const auto ranked = ranked_remedies(comparison_);
        if (ranked.empty() || ranked.front().left || !ranked.front().job) {
            return;
        }
        const auto own = std::ranges::find_if(comparison_.advice, [&](const Remedy& remedy) {
            return remedy.keys == ranked.front().keys;
        });
        if (own != comparison_.advice.end()) {
            own->left = explain(*own->job, comparison_, file_, renderers_).by_name;
        }
    }

    Comparison& comparison_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    NamedErrors errors_;
};

} // namespace

NamedErrors named_errors(const Comparison& comparison)
{
    const CauseLayers& causes = comparison.diagnosis->causes;
    return named_errors(causes.counts, causes.amounts, has_fractions(comparison.metrics),
                        comparison.diagnosis->left_out().total());
}

std::vector<Cure> known_cures(const Comparison& comparison)
{
    std::vector<Cure> cures = comparison.cures;
    const double laid = named_errors(comparison).of(Cause::bias);
    const auto& recommended = comparison.diagnosis->curve.recommended;
    if (laid > 0 && recommended) {
        const bool is_of_own_view = recommended->views == 1;
        cures.push_back({Cause::bias,
                         {recommended->rounded.key},
                         laid,
                         recommended->rounded_outcome,
                         is_of_own_view ? MeasuredBy::curve : MeasuredBy::rerun,
                         is_of_own_view ? comparison.diagnosis->left_by_recommended
                                        : std::optional<NamedErrors>{}});
    }
    return cures;
}

void explain_advice(Comparison& comparison, const scene::SceneFile& file,
                    const Renderers& renderers)
{
    if (methods::traits(comparison.job).has_map) {
        Explainer{comparison, file, renderers}.run();
    }
}

} // namespace gnomon::analysis
